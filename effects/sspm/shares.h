// SPDX-License-Identifier: MIT
// Which cells of the world a shot's paint reaches, and which parts of them: a cell has 4x4x4.
#pragma once

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

// All that a patch touches: visit(key, parts, core) once a cell and facing, until one says false;
// returns whether none did. `core`: the parts that its plane passes through.
template <typename Visit>
bool visitParts(const ShotFrame& frame, const CellGrid& grid, const Patch& patch,
                const Visit& visit) {
  const float partEdge = grid.edge / 4;
  const glm::vec3 normal(patch.plane);
  glm::vec3 low = patch.centre, high = patch.centre;
  for (const glm::vec3& corner : patch.corners) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const float margin = partEdge * kPartMargin + frame.bias;
  const glm::vec3 muzzle = 4.0f * grid.place;
  const glm::ivec3 first(glm::floor(muzzle + (low - margin) / partEdge));
  const glm::ivec3 last(glm::floor(muzzle + (high + margin) / partEdge));
  const glm::vec3 size = glm::abs(normal);
  const float slab = (size.x + size.y + size.z) * 0.5f * partEdge + margin;
  const float reach = frame.range + 0.8661f * partEdge;
  const auto partsIn = [&](const glm::ivec3& lowest, uint64_t& core) {
    const glm::ivec3 from = glm::max(first - lowest, 0), to = glm::min(last - lowest, 3);
    uint64_t parts = 0;
    core = 0;
    for (int k = from.z; k <= to.z; ++k) {
      for (int j = from.y; j <= to.y; ++j) {
        for (int i = from.x; i <= to.x; ++i) {
          const glm::vec3 middle =
              (glm::vec3(lowest + glm::ivec3(i, j, k)) + 0.5f - muzzle) * partEdge;
          const glm::vec3 across = glm::cross(middle, frame.direction);
          const float off = std::abs(glm::dot(normal, middle) - patch.plane.w);
          if (off > slab || glm::dot(across, across) > reach * reach) continue;
          const uint64_t bit = uint64_t{1} << (i | j << 2 | k << 4);
          parts |= bit;
          if (off <= slab - margin + kCoreSlack * partEdge) core |= bit;
        }
      }
    }
    return parts;
  };
  const float most = std::max({size.x, size.y, size.z});
  constexpr float kNearTie = 0.98f;  // a normal between two axes belongs to both
  for (int x = first.x >> 2; x <= last.x >> 2; ++x) {
    for (int y = first.y >> 2; y <= last.y >> 2; ++y) {
      for (int z = first.z >> 2; z <= last.z >> 2; ++z) {
        uint64_t core = 0;
        const uint64_t parts = partsIn(4 * glm::ivec3(x, y, z), core);
        if (parts == 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
          if (size[axis] < kNearTie * most) continue;
          const CellKey key = {grid.cell + glm::ivec3(x, y, z),
                               grid.level + axis * 2 + (normal[axis] < 0 ? 1 : 0)};
          if (!visit(key, parts, core)) return false;
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
