// SPDX-License-Identifier: MIT
// An axis-aligned box in world space.
#pragma once

#include <glm/glm.hpp>

namespace grisaille::scene {

struct Bounds {
  glm::dvec3 min = glm::dvec3(0);  // metres
  glm::dvec3 max = glm::dvec3(0);
};

}  // namespace grisaille::scene
