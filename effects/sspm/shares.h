// SPDX-License-Identifier: MIT
// Which cells of the world a shot's paint reaches, and which parts of them: a cell has 4x4x4.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "cell_table.h"
#include "survey.h"

namespace grisaille::sspm {

constexpr float kPartMargin = 0.1f;  // parts, for surfaces that bend between rays
constexpr float kCoreSlack = 0.02f;  // parts: a plane between two parts is in both

// A place on a surface, from a muzzle, and the way it faces.
struct SurfacePoint {
  int part = 0;
  glm::vec3 at = glm::vec3(0);
  glm::vec3 normal = glm::vec3(0);
};

// What a shot brings to one cell.
struct Share {
  CellKey key = {};
  uint64_t touched = 0;  // parts where it may paint
  uint64_t ragged = 0;   // of these: where something else is seen close by
  glm::vec4 plane = glm::vec4(0);
  bool plain = true;                 // one plane all over
  std::vector<SurfacePoint> points;  // one a part and surface
};

inline double edgeOf(int32_t code) {
  return std::ldexp(1.0, exponentOf(code));
}

// The cells of a level about a muzzle.
struct CellGrid {
  CellGrid(const glm::dvec3& muzzle, int32_t theLevel)
      : level(theLevel),
        edge(static_cast<float>(edgeOf(theLevel))),
        cell(glm::floor(muzzle / edgeOf(theLevel))),
        place(muzzle / edgeOf(theLevel) - glm::dvec3(cell)) {}

  // The lower corner of a cell from the muzzle, metres.
  glm::vec3 corner(const CellKey& key) const { return (glm::vec3(key.cell - cell) - place) * edge; }

  int32_t level;    // as levelCode() has it
  float edge;       // metres
  glm::ivec3 cell;  // the muzzle's
  glm::vec3 place;  // the muzzle's in it, in cells
};

// The middle of a part of a cell, in cells.
inline glm::vec3 middleOf(int part) {
  return (glm::vec3(part & 3, part >> 2 & 3, part >> 4) + 0.5f) * 0.25f;
}

// Whether two surfaces that pass through one part of a cell are one. `edge` of the cell, metres.
inline bool sameSurface(const glm::vec3& at, const glm::vec3& normal, const glm::vec3& otherAt,
                        const glm::vec3& otherNormal, float edge) {
  return std::abs(glm::dot(normal, at - otherAt)) < edge / 16 &&
         glm::dot(normal, otherNormal) > 0.9f;
}

// The parts among which all lie that a patch touches, counted from the muzzle's cell.
struct PartBox {
  glm::ivec3 first, last;  // empty where one of `last` is less
  float margin;            // metres that the patch may be off
};
PartBox partBoxOf(const ShotFrame& frame, const CellGrid& grid, const Patch& patch);

// Bits of a cell's parts.
struct PartBits {
  uint64_t touched = 0;
  uint64_t core = 0;  // the patch's plane passes through
};
PartBits partBitsOf(const ShotFrame& frame, const CellGrid& grid, const Patch& patch,
                    const PartBox& box, const glm::ivec3& cell);

// All that a patch touches: visit(key, bits) once a cell and facing, until one says false; returns
// whether none did.
template <typename Visit>
bool visitParts(const ShotFrame& frame, const CellGrid& grid, const Patch& patch,
                const Visit& visit) {
  const PartBox box = partBoxOf(frame, grid, patch);
  if (glm::any(glm::lessThan(box.last, box.first))) return true;
  const glm::vec3 normal(patch.plane);
  const glm::vec3 size = glm::abs(normal);
  const int a = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  // How far, along the axis that the plane faces most, it strays from where it passes the middle
  // of a column of cells.
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

// A point of the patch's surface in a part of a cell, or as near as its plane comes.
SurfacePoint pointIn(const CellGrid& grid, const Patch& patch, const CellKey& key, int part);

std::vector<Share> sharesOf(const ShotFrame& frame, const CellGrid& grid,
                            const std::vector<Patch>& patches);

}  // namespace grisaille::sspm
