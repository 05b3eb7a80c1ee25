// SPDX-License-Identifier: MIT
#include "shares.h"

#include <algorithm>
#include <bit>

namespace grisaille::sspm {
namespace {

void addPoint(const SurfacePoint& point, float edge, Share& share) {
  const bool known = std::ranges::any_of(share.points, [&](const SurfacePoint& other) {
    return other.part == point.part &&
           sameSurface(other.at, other.normal, point.at, point.normal, edge);
  });
  if (!known) share.points.push_back(point);
}

// Of the places where the patch is seen, those in one cell.
void addSeen(const CellGrid& grid, const Patch& patch, Share& share) {
  for (const glm::vec3& seen : patch.seen) {
    const glm::ivec3 part(glm::floor((grid.place + seen / grid.edge) * 4.0f));
    const glm::ivec3 inCell = part - 4 * (share.key.cell - grid.cell);
    if (glm::any(glm::lessThan(inCell, glm::ivec3(0))) ||
        glm::any(glm::greaterThan(inCell, glm::ivec3(3)))) {
      continue;
    }
    addPoint({.part = inCell.x | inCell.y << 2 | inCell.z << 4,
              .at = seen,
              .normal = glm::vec3(patch.plane)},
             grid.edge, share);
  }
}

}  // namespace

SurfacePoint pointIn(const CellGrid& grid, const Patch& patch, const CellKey& key, int part) {
  const glm::vec3 normal(patch.plane);
  const glm::vec3 middle = grid.corner(key) + middleOf(part) * grid.edge;
  const glm::vec3 half(grid.edge / 8);
  const glm::vec3 onPlane = middle + normal * (patch.plane.w - glm::dot(normal, middle));
  const bool inside = glm::all(glm::lessThanEqual(glm::abs(patch.centre - middle), half)) &&
                      std::abs(glm::dot(normal, patch.centre) - patch.plane.w) < grid.edge / 256;
  return {.part = part,
          .at = inside ? patch.centre : glm::clamp(onPlane, middle - half, middle + half),
          .normal = normal};
}

std::vector<Share> sharesOf(const ShotFrame& frame, const CellGrid& grid,
                            const std::vector<Patch>& patches) {
  std::vector<Share> shares;
  std::vector<CellKey> keys;  // of `shares`, in a row for the search
  for (const Patch& patch : patches) {
    visitParts(frame, grid, patch, [&](const CellKey& key, uint64_t parts, uint64_t core) {
      // The patch before was most likely there too.
      const auto found = std::find(keys.rbegin(), keys.rend(), key);
      size_t index = static_cast<size_t>(keys.rend() - found) - 1;
      if (found == keys.rend()) {
        index = keys.size();
        keys.push_back(key);
        shares.push_back({.key = key, .plane = patch.plane, .points = {}});
      }
      Share& share = shares[index];
      share.plain = share.plain && patch.flat &&
                    std::abs(glm::dot(glm::vec3(share.plane), patch.centre) - share.plane.w) <=
                        0.25f * frame.bias &&
                    glm::dot(glm::vec3(share.plane), glm::vec3(patch.plane)) > 0.98f;
      share.touched |= parts;
      if (patch.ragged) share.ragged |= parts;
      if (patch.seen.empty()) {
        for (uint64_t left = core; left != 0; left &= left - 1) {
          addPoint(pointIn(grid, patch, key, std::countr_zero(left)), grid.edge, share);
        }
      } else {
        addSeen(grid, patch, share);
      }
      return true;
    });
  }
  return shares;
}

}  // namespace grisaille::sspm
