// SPDX-License-Identifier: MIT
#include "lab/claims/floor.h"

#include <algorithm>
#include <array>
#include <memory>

#include "core/scene/rig.h"

namespace grisaille::lab::claims {

void addFloor(scene::Scene& scene) {
  const glm::dvec3 size = scene.bounds.max - scene.bounds.min;
  const glm::dvec3 middle = 0.5 * (scene.bounds.min + scene.bounds.max);
  const auto half = static_cast<float>(5 * std::max(size.x, size.z));
  const auto vertex = static_cast<uint32_t>(scene.positions.size());
  const std::array<glm::vec2, 4> corners = {glm::vec2{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
  for (const glm::vec2& corner : corners) {
    scene.positions.emplace_back(half * corner.x, 0, half * corner.y);
    scene.normals.emplace_back(0, 1, 0);
    scene.texCoords.emplace_back(0, 0);
    if (!scene.colours.empty()) scene.colours.emplace_back(1);
  }
  const auto index = static_cast<uint32_t>(scene.indices.size());
  for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(vertex + corner);
  scene.materials.push_back({.name = "floor"});
  scene.primitives.push_back({.firstIndex = index,
                              .indexCount = 6,
                              .material = static_cast<uint32_t>(scene.materials.size() - 1)});
  glm::dmat4 place(1);
  place[3] = glm::dvec4(middle.x, scene.bounds.min.y, middle.z, 1);
  scene.instances.push_back(
      {.primitive = static_cast<uint32_t>(scene.primitives.size() - 1), .worldFromObject = place});
  if (scene.rig) {
    auto rig = std::make_shared<scene::Rig>(*scene.rig);
    const auto node = static_cast<uint32_t>(rig->nodes.size());
    rig->nodes.push_back({.matrix = place, .weights = {}});
    rig->order.push_back(node);
    rig->instances.push_back({.node = node});
    scene.rig = std::move(rig);
  }
  scene::computeBounds(scene);
}

}  // namespace grisaille::lab::claims
