// SPDX-License-Identifier: MIT
// Scenes with a truth in closed form.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::trace {

class SceneBuilder {
 public:
  scene::Scene scene;

  uint32_t material(const scene::Material& material) {
    scene.materials.push_back(material);
    return static_cast<uint32_t>(scene.materials.size() - 1);
  }

  // Adds a quad with its corners counter-clockwise as seen from the front. They get texture
  // coordinates (0, 1), (1, 1), (1, 0), (0, 0) in this order.
  uint32_t quad(const std::array<glm::vec3, 4>& corners, uint32_t material) {
    const auto base = static_cast<uint32_t>(scene.positions.size());
    const glm::vec3 normal =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const std::array<glm::vec2, 4> texCoords = {glm::vec2(0, 1), {1, 1}, {1, 0}, {0, 0}};
    for (size_t i = 0; i < 4; ++i) vertex(corners[i], normal, texCoords[i]);
    return primitive({base, base + 1, base + 2, base, base + 2, base + 3}, material);
  }

  // A horizontal square that faces up and extends `half` metres to each side of `centre`.
  uint32_t floor(const glm::vec3& centre, float half, uint32_t material) {
    return quad({centre + glm::vec3(-half, 0, half), centre + glm::vec3(half, 0, half),
                 centre + glm::vec3(half, 0, -half), centre + glm::vec3(-half, 0, -half)},
                material);
  }

  uint32_t sphere(const glm::vec3& centre, float radius, uint32_t material) {
    constexpr uint32_t kRings = 192;
    constexpr uint32_t kSegments = 384;
    const auto base = static_cast<uint32_t>(scene.positions.size());
    std::vector<uint32_t> indices;
    for (uint32_t ring = 0; ring <= kRings; ++ring) {
      const double theta = std::numbers::pi * ring / kRings;
      for (uint32_t segment = 0; segment <= kSegments; ++segment) {
        const double phi = 2 * std::numbers::pi * segment / kSegments;
        const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                          -std::sin(theta) * std::sin(phi));
        vertex(centre + radius * n, n, glm::vec2(0));
        if (ring == kRings || segment == kSegments) continue;
        const uint32_t a = base + ring * (kSegments + 1) + segment;
        const uint32_t b = a + kSegments + 1;
        indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
      }
    }
    return primitive(indices, material);
  }

  void place(uint32_t primitive, const glm::dmat4& worldFromObject = glm::dmat4(1)) {
    scene.instances.push_back({primitive, worldFromObject});
  }

 private:
  void vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& texCoord) {
    scene.positions.push_back(position);
    scene.normals.push_back(normal);
    scene.texCoords.push_back(texCoord);
  }

  uint32_t primitive(const std::vector<uint32_t>& indices, uint32_t material) {
    scene.primitives.push_back({.firstIndex = static_cast<uint32_t>(scene.indices.size()),
                                .indexCount = static_cast<uint32_t>(indices.size()),
                                .material = material});
    scene.indices.insert(scene.indices.end(), indices.begin(), indices.end());
    return static_cast<uint32_t>(scene.primitives.size() - 1);
  }
};

inline scene::Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target,
                              const glm::dvec3& up = glm::dvec3(0, 1, 0)) {
  scene::Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.up = up;
  return camera;
}

}  // namespace grisaille::trace
