// SPDX-License-Identifier: MIT
#include "shares.h"

#include <algorithm>
#include <bit>

namespace grisaille::sspm {
namespace {

void addPoints(const ShotFrame& frame, const Patch& patch, uint64_t parts, Share& share) {
  const auto edge = static_cast<float>(edgeOf(share.key.code));
  for (uint64_t left = parts; left != 0; left &= left - 1) {
    const SurfacePoint point = pointIn(frame, patch, share.key, std::countr_zero(left));
    const bool known = std::ranges::any_of(share.points, [&](const SurfacePoint& other) {
      return other.part == point.part &&
             sameSurface(other.at, other.normal, point.at, point.normal, edge);
    });
    if (!known) share.points.push_back(point);
  }
}

}  // namespace

SurfacePoint pointIn(const ShotFrame& frame, const Patch& patch, const CellKey& key, int part) {
  const auto edge = static_cast<float>(edgeOf(key.code));
  const glm::vec3 normal(patch.plane);
  const glm::vec3 middle = cornerFrom(key, frame.origin) + middleOf(part) * edge;
  const glm::vec3 half(edge / 8);
  const glm::vec3 onPlane = middle + normal * (patch.plane.w - glm::dot(normal, middle));
  const bool inside = glm::all(glm::lessThanEqual(glm::abs(patch.centre - middle), half));
  return {.part = part,
          .at = inside ? patch.centre : glm::clamp(onPlane, middle - half, middle + half),
          .normal = normal};
}

std::vector<Share> sharesOf(const ShotFrame& frame, const std::vector<Patch>& patches,
                            int32_t level) {
  std::vector<Share> shares;
  for (const Patch& patch : patches) {
    visitParts(frame, patch, level, [&](const CellKey& key, uint64_t parts) {
      // The patch before was most likely there too.
      auto found = std::find_if(shares.rbegin(), shares.rend(),
                                [&](const Share& share) { return share.key == key; });
      if (found == shares.rend()) {
        shares.push_back({.key = key, .plane = patch.plane, .points = {}});
        found = shares.rbegin();
      }
      Share& share = *found;
      share.plain = share.plain &&
                    std::abs(glm::dot(glm::vec3(share.plane), patch.centre) - share.plane.w) <=
                        0.25f * frame.bias &&
                    glm::dot(glm::vec3(share.plane), glm::vec3(patch.plane)) > 0.98f;
      share.touched |= parts;
      if (patch.ragged) share.ragged |= parts;
      addPoints(frame, patch, parts, share);
      return true;
    });
  }
  return shares;
}

}  // namespace grisaille::sspm
