// SPDX-License-Identifier: MIT
#include "shares.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>

namespace grisaille::sspm {
namespace {

// Whether a part has a point of the share's plane, and needs no other.
bool isKnown(const Share& share, const glm::vec4& plane, int part) {
  return (share.known >> part & 1) != 0 && share.plane == plane;
}

// plane: on which the point lies.
void addPoint(const SurfacePoint& point, const glm::vec4& plane, float edge, Share& share) {
  const bool known = std::ranges::any_of(share.points, [&](const SurfacePoint& other) {
    return other.part == point.part &&
           sameSurface(other.at, other.normal, point.at, point.normal, edge);
  });
  if (!known) share.points.push_back(point);
  if (plane == share.plane) share.known |= uint64_t{1} << point.part;
}

// Adds the patch's hits that lie in the share's cell.
void addSeen(const CellGrid& grid, const Patch& patch, Share& share) {
  for (const glm::vec3& seen : patch.seen) {
    const glm::ivec3 part(glm::floor((grid.place + seen / grid.edge) * 4.0f));
    const glm::ivec3 inCell = part - 4 * (share.key.cell - grid.cell);
    if (glm::any(glm::lessThan(inCell, glm::ivec3(0))) ||
        glm::any(glm::greaterThan(inCell, glm::ivec3(3)))) {
      continue;
    }
    const int index = inCell.x | inCell.y << 2 | inCell.z << 4;
    if (isKnown(share, patch.plane, index)) continue;
    addPoint({.part = index, .at = seen, .normal = glm::vec3(patch.plane)}, patch.plane, grid.edge,
             share);
  }
}

}  // namespace

KnownPoint knownAt(const glm::vec3& inCell, const glm::vec3& normal) {
  const glm::uvec3 p(glm::clamp(inCell * 1024.0f, 0.0f, 1023.0f));
  return {.place = (p.x | p.y << 10 | p.z << 20) & 0x3FFFFFFFu,
          .normal = glm::packSnorm3x10_1x2(glm::vec4(normal, 0))};
}

int partOf(const KnownPoint& known) {
  return static_cast<int>((known.place >> 8 & 3u) | (known.place >> 18 & 3u) << 2 |
                          (known.place >> 28 & 3u) << 4);
}

SurfacePoint pointOf(const KnownPoint& known, const glm::vec3& corner, float edge) {
  const glm::vec3 steps(known.place & 1023u, known.place >> 10 & 1023u, known.place >> 20);
  return {.part = partOf(known),
          .at = corner + edge * (steps + 0.5f) / 1024.0f,
          .normal = glm::vec3(glm::unpackSnorm3x10_1x2(known.normal))};
}

Spots spotsOf(const SurfacePoint& piece, float edge, float width) {
  const glm::vec3 size = glm::abs(piece.normal);
  const int a = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  const glm::vec3 middle = edge * middleOf(piece.part);
  const float slopeB = -piece.normal[b] / piece.normal[a];
  const float slopeC = -piece.normal[c] / piece.normal[a];
  Spots spots;
  spots.half = width / 2 * glm::length(glm::vec3(1, 1, std::abs(slopeB) + std::abs(slopeC)));
  for (size_t i = 0; i < kSpots; ++i) {
    const auto row = static_cast<float>(i / kSpotsAWay),
               column = static_cast<float>(i % kSpotsAWay);
    glm::vec3& at = spots.centres[i];
    at[b] = middle[b] + width * (column + 0.5f - kSpotsAWay / 2.0f);
    at[c] = middle[c] + width * (row + 0.5f - kSpotsAWay / 2.0f);
    at[a] = piece.at[a] + slopeB * (at[b] - piece.at[b]) + slopeC * (at[c] - piece.at[c]);
  }
  return spots;
}

// Intersection of two boxes: of the corners, and of the ellipse in which the cylinder cuts the
// plane.
PartBox partBoxOf(const ShotFrame& frame, const CellGrid& grid, const Patch& patch) {
  const float partEdge = grid.edge / 4;
  const float margin = partEdge * kPartMargin + frame.bias;
  glm::vec3 low = patch.centre, high = patch.centre;
  for (const glm::vec3& corner : patch.corners) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const glm::vec3 normal(patch.plane);
  const float facing = glm::dot(normal, frame.direction);
  const glm::vec3 level = glm::cross(normal, frame.direction);
  const float slant = glm::length(level);
  if (std::abs(facing) > 1e-4f && slant > 1e-4f) {
    const glm::vec3 u = level / slant, v = glm::cross(normal, u);
    const float reach = frame.range + partEdge;
    const glm::vec3 half = glm::sqrt(u * u + v * v / (facing * facing)) * reach;
    const glm::vec3 middle = frame.direction * (patch.plane.w / facing);
    low = glm::max(low, middle - half);
    high = glm::min(high, middle + half);
  }
  const glm::vec3 muzzle = 4.0f * grid.place;
  const auto partOf = [&](const glm::vec3& at) {
    return glm::ivec3(glm::floor(glm::clamp(muzzle + at / partEdge, -1e9f, 1e9f)));
  };
  return {partOf(low - margin), partOf(high + margin), margin};
}

PartBits partBitsOf(const ShotFrame& frame, const CellGrid& grid, const Patch& patch,
                    const PartBox& box, const glm::ivec3& cell) {
  const float partEdge = grid.edge / 4;
  const glm::vec3 normal(patch.plane);
  const glm::vec3 size = glm::abs(normal);
  const float core = (size.x + size.y + size.z) * 0.5f * partEdge;
  const float reach = frame.range + 0.8661f * partEdge;
  const glm::ivec3 from = glm::max(box.first - 4 * cell, 0), to = glm::min(box.last - 4 * cell, 3);
  const glm::vec3 corner = (glm::vec3(cell) - grid.place) * grid.edge;
  PartBits bits;
  for (int k = from.z; k <= to.z; ++k) {
    for (int j = from.y; j <= to.y; ++j) {
      for (int i = from.x; i <= to.x; ++i) {
        const glm::vec3 middle = corner + (glm::vec3(i, j, k) + 0.5f) * partEdge;
        const glm::vec3 across = glm::cross(middle, frame.direction);
        const float off = std::abs(glm::dot(normal, middle) - patch.plane.w);
        if (off > core + box.margin || glm::dot(across, across) > reach * reach) continue;
        const uint64_t bit = uint64_t{1} << (i | j << 2 | k << 4);
        bits.touched |= bit;
        if (off <= core + kCoreSlack * partEdge) bits.core |= bit;
      }
    }
  }
  return bits;
}

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
  std::vector<CellKey> keys;  // of `shares`, contiguous for the search
  size_t last = 0;            // the previous patch was probably in the same cell
  for (const Patch& patch : patches) {
    visitParts(frame, grid, patch, [&](const CellKey& key, const PartBits& bits) {
      if (last >= keys.size() || keys[last] != key) {
        last = static_cast<size_t>(std::ranges::find(keys, key) - keys.begin());
      }
      if (last == keys.size()) {
        keys.push_back(key);
        shares.push_back({.key = key, .plane = patch.plane, .points = {}});
      }
      Share& share = shares[last];
      share.plain = share.plain && serves(share.plane, patch.centre, patch.plane, frame.bias);
      share.touched |= bits.touched;
      if (patch.ragged) share.ragged |= bits.touched;
      if (patch.seen.empty()) {
        for (uint64_t left = bits.core; left != 0; left &= left - 1) {
          const int part = std::countr_zero(left);
          if (isKnown(share, patch.plane, part)) continue;
          addPoint(pointIn(grid, patch, key, part), patch.plane, grid.edge, share);
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
