// SPDX-License-Identifier: MIT
// What one shot's muzzle sees: which of the points within the shot's range lie in sight.
//
// Points are told by their offset q from the muzzle. With w the shot's direction and u, v its
// normals, q lies in the slope (q.u, q.v) / q.w, and the slope is put on a map that is fine where
// the paint lands and coarse beside the muzzle: with s0 = range / farthest hit, a slope of length
// s <= s0 stands at s / s0 from the centre, a longer one at 1 + ln(s / s0). A unit of the map is
// one range wide wherever the shot's cylinder ends in that slope. The map is a tree of squares;
// a leaf holds the plane of the surface that its rays hit: what lies before it is in sight.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "grisaille/effect.h"
#include "shot.h"

namespace grisaille::sspm {

constexpr float kMapReach = 8;  // the map spans [-8, 8] on both axes

// A word of a map: what a square of it holds. Offsets count blocks of four 32-bit words from the
// map's start. The same in shaders/sspm/surface.comp.
constexpr uint32_t kOpen = 0;             // nothing within the cylinder
constexpr uint32_t kPlane = 0x40000000u;  // a block: normal towards the muzzle, its product with q
constexpr uint32_t kNode = 0x80000000u;   // four blocks: the words of 4x4 squares, by rows
constexpr uint32_t kSplit = 0xC0000000u;  // a block: bits of 4x4 squares, word where 0, where 1
constexpr uint32_t kTag = 0xC0000000u;

// Where a shot stands and how its map is laid.
struct ShotFrame {
  // `range` in metres, over 0. Axes for a unit direction, as shaders/sspm/surface.comp makes them
  // too (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
  ShotFrame(const Shot& shot, float range);

  // The farthest surface in the cylinder: sets slope and bias.
  void setFarthest(float metres);

  // How far an offset lies from the shot's ray, metres.
  float across(const glm::vec3& q) const { return glm::length(glm::cross(q, direction)); }

  // The map's place of an offset in front of the muzzle.
  glm::vec2 placeOf(const glm::vec3& q) const;

  glm::dvec3 origin;
  glm::vec3 direction;
  glm::vec3 right, up;
  float range;
  float slope = 0;  // s0
  float bias = 0;   // metres that a point may lie behind a leaf's plane
};

struct ShotMap {
  uint32_t root = kOpen;
  std::vector<uint32_t> blocks;  // four words each
};

// Whether the muzzle sees the point at offset q on a facet with this normal, which lies in the
// cylinder and faces the muzzle.
bool inSight(const ShotFrame& frame, uint32_t root, const uint32_t* blocks, const glm::vec3& q,
             const glm::vec3& facing);

}  // namespace grisaille::sspm
