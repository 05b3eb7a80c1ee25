// SPDX-License-Identifier: MIT
// Voxelizes a shot's patches: which cells of the world its paint reaches, and which of the 4x4x4
// parts of each cell.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "cell_table.h"
#include "survey.h"

namespace grisaille::sspm {

constexpr float kPartMargin = 0.1f;  // in parts, for surfaces that bend between rays
constexpr float kCoreSlack = 0.02f;  // in parts: a plane between two parts belongs to both

// A point of a surface.
struct SurfacePoint {
  int part = 0;                 // of the cell, 0 ... 63
  glm::vec3 at = glm::vec3(0);  // offset from the muzzle, metres
  glm::vec3 normal = glm::vec3(0);
};

// A cell's known piece at a point, in cells from the cell's lower corner, each 0 to 1.
KnownPoint knownAt(const glm::vec3& inCell, const glm::vec3& normal);
int partOf(const KnownPoint& known);
// corner: the cell's lower corner, relative to the muzzle, metres. edge: width of the cell, metres.
SurfacePoint pointOf(const KnownPoint& known, const glm::vec3& corner, float edge);

constexpr int kSpotsAWay = 4;
constexpr size_t kSpots = size_t{kSpotsAWay} * kSpotsAWay;

// A piece's plane in its part of the cell, cut into spots along two axes.
struct Spots {
  std::array<glm::vec3, kSpots> centres = {};
  float half = 0;  // farthest point of a spot from its centre
};
// piece: with its position in the space of the spots, whose origin is the cell's lower corner.
// edge, width: of the cell and of a spot, in one unit.
Spots spotsOf(const SurfacePoint& piece, float edge, float width);

// Part of a shot that lies in one cell.
struct Share {
  CellKey key = {};
  uint64_t touched = 0;  // parts that it may paint
  uint64_t ragged = 0;   // those of `touched` with another surface close by
  glm::vec4 plane = glm::vec4(0);
  bool plain = true;                 // `plane` serves the whole cell
  uint64_t known = 0;                // parts with a point on `plane`
  std::vector<SurfacePoint> points;  // one per part and surface
};

// Width of a cell, metres.
inline double edgeOf(int32_t code) {
  return std::ldexp(1.0, exponentOf(code));
}

// The grid of a level, relative to a muzzle.
struct CellGrid {
  CellGrid(const glm::dvec3& muzzle, int32_t theLevel)
      : level(theLevel),
        edge(static_cast<float>(edgeOf(theLevel))),
        cell(glm::floor(muzzle / edgeOf(theLevel))),
        place(muzzle / edgeOf(theLevel) - glm::dvec3(cell)) {}

  // Lower corner of a cell, relative to the muzzle, metres.
  glm::vec3 corner(const CellKey& key) const { return (glm::vec3(key.cell - cell) - place) * edge; }

  int32_t level;    // see levelCode()
  float edge;       // width of a cell, metres
  glm::ivec3 cell;  // of the muzzle
  glm::vec3 place;  // the muzzle's position in its cell, in cells
};

// Centre of a part, relative to the cell's lower corner, in cells.
inline glm::vec3 middleOf(int part) {
  return (glm::vec3(part & 3, part >> 2 & 3, part >> 4) + 0.5f) * 0.25f;
}

// Whether two points in one part of a cell lie on the same surface. edge: of the cell, metres.
inline bool sameSurface(const glm::vec3& at, const glm::vec3& normal, const glm::vec3& otherAt,
                        const glm::vec3& otherNormal, float edge) {
  return std::abs(glm::dot(normal, at - otherAt)) < edge / 16 &&
         glm::dot(normal, otherNormal) > 0.9f;
}

// Bounding box of a patch, in parts, counted from the muzzle's cell.
struct PartBox {
  glm::ivec3 first, last;  // inclusive; empty if a component of `last` is less
  float margin;            // error bound of the patch, metres
};
PartBox partBoxOf(const ShotFrame& frame, const CellGrid& grid, const Patch& patch);

// Masks of a cell's parts.
struct PartBits {
  uint64_t touched = 0;  // within the margin of the patch
  uint64_t core = 0;     // the patch's plane passes through
};
PartBits partBitsOf(const ShotFrame& frame, const CellGrid& grid, const Patch& patch,
                    const PartBox& box, const glm::ivec3& cell);

// Rasterizes a patch into cells: calls visit(key, bits) for each cell and facing that the patch
// touches, until a call returns false. Returns false in that case, else true.
template <typename Visit>
bool visitParts(const ShotFrame& frame, const CellGrid& grid, const Patch& patch,
                const Visit& visit) {
  const PartBox box = partBoxOf(frame, grid, patch);
  if (glm::any(glm::lessThan(box.last, box.first))) return true;
  const glm::vec3 normal(patch.plane);
  const glm::vec3 size = glm::abs(normal);
  const int a = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  // Half the plane's extent within a column of cells along its dominant axis a, in cells, with the
  // margin.
  const float stray = 0.5f * (size[b] + size[c]) / size[a] + 2 * box.margin / grid.edge + 0.01f;
  constexpr float kNearTie = 0.98f;  // a normal between two axes belongs to both
  glm::ivec3 cell;
  for (cell[b] = box.first[b] >> 2; cell[b] <= box.last[b] >> 2; ++cell[b]) {
    for (cell[c] = box.first[c] >> 2; cell[c] <= box.last[c] >> 2; ++cell[c]) {
      const float offB = static_cast<float>(cell[b]) + 0.5f - grid.place[b];
      const float offC = static_cast<float>(cell[c]) + 0.5f - grid.place[c];
      const float along =
          (patch.plane.w / grid.edge - normal[b] * offB - normal[c] * offC) / normal[a] +
          grid.place[a];
      const auto cellAt = [](float at) {
        return static_cast<int>(std::floor(glm::clamp(at, -1e9f, 1e9f)));
      };
      const int last = std::min(cellAt(along + stray), box.last[a] >> 2);
      for (cell[a] = std::max(cellAt(along - stray), box.first[a] >> 2); cell[a] <= last;
           ++cell[a]) {
        const PartBits bits = partBitsOf(frame, grid, patch, box, cell);
        if (bits.touched == 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
          if (size[axis] < kNearTie * size[a]) continue;
          const CellKey key = {grid.cell + cell,
                               grid.level + axis * 2 + (normal[axis] < 0 ? 1 : 0)};
          if (!visit(key, bits)) return false;
        }
      }
    }
  }
  return true;
}

// A point of the patch's surface in a part of a cell: its centre if that is in the part, else the
// point of its plane nearest to the part's centre, clamped to the part.
SurfacePoint pointIn(const CellGrid& grid, const Patch& patch, const CellKey& key, int part);

// Shares of all patches of a shot, one per cell and facing.
std::vector<Share> sharesOf(const ShotFrame& frame, const CellGrid& grid,
                            const std::vector<Patch>& patches);

}  // namespace grisaille::sspm
