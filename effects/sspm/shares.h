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

// A place on a surface, from a muzzle, and the way it faces.
struct SurfacePoint {
  int part = 0;
  glm::vec3 at = glm::vec3(0);
  glm::vec3 normal = glm::vec3(0);
};

// What a shot brings to one cell.
struct Share {
  CellKey key;
  uint64_t touched = 0;  // parts where it may paint
  uint64_t ragged = 0;   // of these: where something else is seen close by
  glm::vec4 plane = glm::vec4(0);
  bool plain = true;                 // one plane all over
  std::vector<SurfacePoint> points;  // one a part and surface
};

inline double edgeOf(int32_t code) {
  return std::ldexp(1.0, exponentOf(code));
}

// The lower corner of a cell from a muzzle, metres.
inline glm::vec3 cornerFrom(const CellKey& key, const glm::dvec3& muzzle) {
  return glm::vec3(glm::dvec3(key.cell) * edgeOf(key.code) - muzzle);
}

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

// All that a patch touches: visit(key, parts) once a cell and facing, until one says false; returns
// whether none did. `level` as levelCode() has it.
template <typename Visit>
bool visitParts(const ShotFrame& frame, const Patch& patch, int32_t level, const Visit& visit) {
  const double edge = edgeOf(level);
  const auto partEdge = static_cast<float>(edge / 4);
  const glm::vec3 normal(patch.plane);
  glm::vec3 low = patch.centre, high = patch.centre;
  for (const glm::vec3& corner : patch.corners) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const float margin = partEdge * 0.1f + frame.bias;
  const glm::ivec3 first(glm::floor((frame.origin + glm::dvec3(low - margin)) / edge * 4.0));
  const glm::ivec3 last(glm::floor((frame.origin + glm::dvec3(high + margin)) / edge * 4.0));
  const glm::vec3 size = glm::abs(normal);
  const float slab = (size.x + size.y + size.z) * 0.5f * partEdge + margin;
  const float most = std::max({size.x, size.y, size.z});
  constexpr float kNearTie = 0.98f;  // a normal between two axes belongs to both
  for (int x = first.x >> 2; x <= last.x >> 2; ++x) {
    for (int y = first.y >> 2; y <= last.y >> 2; ++y) {
      for (int z = first.z >> 2; z <= last.z >> 2; ++z) {
        CellKey key{{x, y, z}, level};
        const glm::vec3 corner = cornerFrom(key, frame.origin);
        const glm::ivec3 from = glm::max(first - key.cell * 4, 0);
        const glm::ivec3 to = glm::min(last - key.cell * 4, 3);
        uint64_t parts = 0;
        for (int k = from.z; k <= to.z; ++k) {
          for (int j = from.y; j <= to.y; ++j) {
            for (int i = from.x; i <= to.x; ++i) {
              const glm::vec3 middle = corner + (glm::vec3(i, j, k) + 0.5f) * partEdge;
              if (std::abs(glm::dot(normal, middle) - patch.plane.w) > slab) continue;
              if (frame.across(middle) > frame.range + 0.8661f * partEdge) continue;
              parts |= uint64_t{1} << (i | j << 2 | k << 4);
            }
          }
        }
        if (parts == 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
          if (size[axis] < kNearTie * most) continue;
          key.code = level + axis * 2 + (normal[axis] < 0 ? 1 : 0);
          if (!visit(key, parts)) return false;
        }
      }
    }
  }
  return true;
}

// A point of the patch's surface in a part of a cell, or as near as its plane comes.
SurfacePoint pointIn(const ShotFrame& frame, const Patch& patch, const CellKey& key, int part);

std::vector<Share> sharesOf(const ShotFrame& frame, const std::vector<Patch>& patches,
                            int32_t level);

}  // namespace grisaille::sspm
