// SPDX-License-Identifier: MIT
#include "tests/support/scenes.h"

#include <array>

namespace grisaille::tests {

void addQuad(scene::Scene& scene, const std::array<glm::vec3, 4>& corners, glm::vec3 normal,
             uint32_t material) {
  const auto first = static_cast<uint32_t>(scene.positions.size());
  constexpr glm::vec2 kTexCoords[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  for (size_t i = 0; i < corners.size(); ++i) {
    scene.positions.push_back(corners[i]);
    scene.normals.push_back(normal);
    scene.texCoords.push_back(kTexCoords[i]);
  }
  const auto firstIndex = static_cast<uint32_t>(scene.indices.size());
  for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(first + corner);
  scene.primitives.push_back({.firstIndex = firstIndex, .indexCount = 6, .material = material});
  scene.instances.push_back({.primitive = static_cast<uint32_t>(scene.primitives.size() - 1),
                             .worldFromObject = glm::dmat4(1)});
  scene::computeBounds(scene);
}

void addBox(scene::Scene& scene, const glm::dmat4& worldFromObject, uint32_t material) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 normal(0), u(0), v(0);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = side;
      addQuad(scene, {normal - u - v, normal + u - v, normal + u + v, normal - u + v}, normal,
              material);
      scene.instances.back().worldFromObject = worldFromObject;
    }
  }
  scene::computeBounds(scene);
}

scene::Scene floorScene(float size) {
  scene::Scene scene;
  scene.name = "floor";
  scene.materials.push_back({.name = "white"});
  const float h = size / 2;
  addQuad(scene, {glm::vec3(-h, 0, h), {h, 0, h}, {h, 0, -h}, {-h, 0, -h}}, {0, 1, 0});
  return scene;
}

scene::Scene cornerScene(float size) {
  scene::Scene scene = floorScene(size);
  scene.name = "corner";
  const float h = size / 2;
  addQuad(scene, {glm::vec3(-h, 0, 0), {h, 0, 0}, {h, h, 0}, {-h, h, 0}}, {0, 0, 1});
  return scene;
}

scene::Scene wallScene(float width, float height) {
  scene::Scene scene;
  scene.name = "wall";
  scene.materials.push_back({.name = "white"});
  const float w = width / 2, h = height / 2;
  addQuad(scene, {glm::vec3(-w, -h, 0), {w, -h, 0}, {w, h, 0}, {-w, h, 0}}, {0, 0, 1});
  return scene;
}

}  // namespace grisaille::tests
