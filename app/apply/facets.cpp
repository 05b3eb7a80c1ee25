// SPDX-License-Identifier: MIT
#include "app/apply/facets.h"

#include <algorithm>
#include <cmath>

namespace grisaille::app {

Facets::Facets(const Surfaces& surfaces)
    : viewDepth_(surfaces.viewDepth),
      view_(scene::viewOf(surfaces.camera, {viewDepth_.width, viewDepth_.height})),
      // Depths of half floats are exact to 1 in 2000: in a large picture, the next pixel's depth
      // would be rounding alone.
      step_(std::max(1u, viewDepth_.width / 256)) {}

glm::dvec3 Facets::position(uint32_t x, uint32_t y) const {
  return scene::viewPosition(view_, glm::dvec2(x, y) + 0.5, depth(x, y));
}

glm::dvec3 Facets::sight(uint32_t x, uint32_t y) const {
  return view_.orthographic ? glm::dvec3(0, 0, -1) : position(x, y);
}

std::optional<glm::dvec3> Facets::normal(uint32_t x, uint32_t y) const {
  if (x < step_ || y < step_ || x + step_ >= viewDepth_.width || y + step_ >= viewDepth_.height) {
    return std::nullopt;
  }
  // On a plane, the inverse of the depth is linear in the picture; the depth itself is, if the
  // camera is orthographic.
  constexpr double kBend = 0.003, kOrthographicBend = 0.4;  // of the depth, and of the step
  const double z = depth(x, y);
  const double step = step_ * scene::pixelSize(view_, z);
  const auto straight = [&](double a, double b) {
    if (!(a > 0 && b > 0)) return false;
    return view_.orthographic ? std::abs(a + b - 2 * z) < kOrthographicBend * step
                              : std::abs(z / a + z / b - 2) < kBend;
  };
  if (!straight(depth(x - step_, y), depth(x + step_, y)) ||
      !straight(depth(x, y - step_), depth(x, y + step_))) {
    return std::nullopt;
  }
  const glm::dvec3 right = position(x + step_, y) - position(x - step_, y);
  const glm::dvec3 up = position(x, y - step_) - position(x, y + step_);
  const glm::dvec3 normal = glm::cross(right, up);
  const double length = glm::length(normal);
  if (!(length > 0) || glm::dot(normal, sight(x, y)) >= 0) return std::nullopt;
  return normal / length;
}

}  // namespace grisaille::app
