// SPDX-License-Identifier: MIT
// How normals follow a linear map of positions.
#pragma once

#include <glm/glm.hpp>

namespace grisaille::scene {

// The cofactor matrix: it equals the inverse transpose up to a positive factor and exists for
// singular maps too. For a mirroring map it is negated, so that normals do not flip.
inline glm::dmat3 normalMap(const glm::dmat3& m) {
  const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::determinant(m) < 0 ? -cofactor : cofactor;
}

}  // namespace grisaille::scene
