// SPDX-License-Identifier: MIT
// A shot's map: a shadow map from the muzzle, which tells which points in the shot's range the
// muzzle sees.
//
// - A point has the offset q from the muzzle. With w the shot's direction and u, v two axes normal
//   to it, its slope is (q.u, q.v) / q.w.
// - The map is fine where the paint lands and coarse beside the muzzle. With s0 = range / farthest
//   hit, a slope of length s <= s0 lies at s / s0 from the map's centre, a longer one at 1 + ln(s /
//   s0). One unit of the map is one range wide wherever the shot's cylinder ends in that slope.
// - The map is a tree of squares. A leaf holds the plane of the surface that its rays hit, with the
//   normal towards the muzzle. The muzzle sees points in front of that plane.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "grisaille/effect.h"
#include "shot.h"

namespace grisaille::sspm {

constexpr float kMapReach = 8;  // the map spans [-8, 8] on both axes

// Word of a square of the map: a tag, and an offset in blocks of four 32-bit words from the map's
// start. Same as in shaders/sspm/walk.glsl.
constexpr uint32_t kOpen = 0;             // no surface in the cylinder
constexpr uint32_t kPlane = 0x40000000u;  // leaf; one block: xyz: normal, w: dot(normal, q)
constexpr uint32_t kNode = 0x80000000u;   // four blocks: words of 4x4 squares, by rows
constexpr uint32_t kSplit = 0xC0000000u;  // one block: a bit per 4x4 square, word for 0, word for 1
constexpr uint32_t kTag = 0xC0000000u;

// Position and axes of a shot, and scale of its map.
struct ShotFrame {
  // range: metres, > 0. The shot's direction has unit length. The axes are those of Duff et al.
  // 2017, "Building an Orthonormal Basis, Revisited"; shaders/sspm/walk.glsl computes the same.
  ShotFrame(const Shot& shot, float range);

  // Sets slope and bias, from the distance of the farthest surface in the cylinder, metres.
  void setFarthest(float metres);

  // Distance of an offset from the shot's ray, metres.
  float across(const glm::vec3& q) const { return glm::length(glm::cross(q, direction)); }

  // Position on the map of an offset in front of the muzzle, -8 to 8.
  glm::vec2 placeOf(const glm::vec3& q) const;

  glm::dvec3 origin;
  glm::vec3 direction;
  glm::vec3 right, up;
  float range;
  float slope = 0;  // s0
  float bias = 0;   // largest distance of a visible point behind a leaf's plane, metres
};

struct ShotMap {
  uint32_t root = kOpen;
  std::vector<uint32_t> blocks;  // four words each
};

// Whether the muzzle sees the point at offset q. The point lies in the cylinder, on a facet that
// faces the muzzle.
// root, blocks: of the map. facing: the facet's unit normal.
bool inSight(const ShotFrame& frame, uint32_t root, const uint32_t* blocks, const glm::vec3& q,
             const glm::vec3& facing);

}  // namespace grisaille::sspm
