// SPDX-License-Identifier: MIT
// Conditions that a valid triangle mesh fulfils.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/scene/scene.h"

namespace grisaille::scene {

// Number of edges without a matching reverse edge, compared by position. 0 for closed solids with
// consistent winding.
inline size_t openEdges(const Scene& scene, const Primitive& primitive) {
  const auto less = [](const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::map<glm::vec3, uint32_t, decltype(less)> ids(less);
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (uint32_t i = 0; i < primitive.indexCount; i += 3) {
    uint32_t at[3];
    for (uint32_t k = 0; k < 3; ++k) {
      const glm::vec3& p = scene.positions[scene.indices[primitive.firstIndex + i + k]];
      at[k] = ids.try_emplace(p, static_cast<uint32_t>(ids.size())).first->second;
    }
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = at[k], b = at[(k + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  size_t open = 0;
  for (const auto& [edge, balance] : edges) open += balance != 0;
  return open;
}

inline double volume(const Scene& scene, const Primitive& primitive) {
  double sum = 0;
  for (uint32_t i = 0; i < primitive.indexCount; i += 3) {
    const auto p = [&](uint32_t k) {
      return glm::dvec3(scene.positions[scene.indices[primitive.firstIndex + i + k]]);
    };
    sum += glm::dot(p(0), glm::cross(p(1), p(2))) / 6;
  }
  return sum;
}

}  // namespace grisaille::scene
