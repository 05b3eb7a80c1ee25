// SPDX-License-Identifier: MIT
#include "lab/oracle/history.h"

#include <algorithm>
#include <cmath>

namespace grisaille::lab::oracle {

Mean PastFrame::seenAt(const glm::dvec3& place, const glm::dvec3& normal) const {
  constexpr Mean kUnseen{.open = 0, .frames = 0};
  constexpr double kSameSurface = 0.01;  // view depths; orthographic: picture heights
  const glm::dvec3 position = view.viewFromWorld() * (place - view.eye());
  const glm::dvec3 facing = view.viewFromWorld() * normal;
  if (position.z >= 0) return kUnseen;
  const glm::dvec2 pixel = view.pixelOf(position);
  const double tall = view.orthographic() ? view.size().y / std::abs(view.focal().y) : -position.z;
  const glm::dvec2 at = (pixel - 0.5) / static_cast<double>(scale);
  const glm::dvec2 last = glm::dvec2(texels) - 0.5;
  if (at.x < -0.5 || at.y < -0.5 || at.x > last.x || at.y > last.y) return kUnseen;
  const glm::dvec2 first = glm::floor(at), part = at - first;
  Mean sum = kUnseen;
  double weights = 0;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 corner(i & 1, i >> 1);
    const glm::ivec2 texel = glm::clamp(glm::ivec2(first) + corner, glm::ivec2(0), texels - 1);
    const double depth = view.depth(texel * scale);
    if (depth <= 0 || glm::dot(view.worldNormal(texel * scale), normal) <= 0.8) continue;
    const glm::dvec3 apart = view.position(texel * scale) - position;
    const double off = std::abs(glm::dot(facing, apart)) / (kSameSurface * tall);
    const double share =
        (corner.x != 0 ? part.x : 1 - part.x) * (corner.y != 0 ? part.y : 1 - part.y);
    const double weight = share * std::max(0.0, 1 - off);
    const Mean& old = means[static_cast<size_t>(texel.y) * static_cast<size_t>(texels.x) +
                            static_cast<size_t>(texel.x)];
    sum.open += weight * old.open;
    sum.frames += weight * old.frames;
    weights += weight;
  }
  if (weights <= 0.01) return kUnseen;
  return {.open = sum.open / weights, .frames = sum.frames / weights};
}

}  // namespace grisaille::lab::oracle
