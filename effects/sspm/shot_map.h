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
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "grisaille/effect.h"

namespace grisaille::sspm {

// Rays in, hits out; false where rays cannot be cast.
using CastRays = std::function<bool(std::span<const grisaille_ray>, std::span<grisaille_hit>)>;

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
  glm::dvec3 origin = glm::dvec3(0);
  glm::vec3 direction = glm::vec3(0, 0, -1);
  glm::vec3 right = glm::vec3(1, 0, 0);
  glm::vec3 up = glm::vec3(0, 1, 0);
  float range = 0;  // metres
  float slope = 0;  // s0
  float bias = 0;   // metres that a point may lie behind a leaf's plane
};

// `right` and `up` for a unit direction, as shaders/sspm/surface.comp makes them too (Duff et al.
// 2017, "Building an Orthonormal Basis, Revisited").
void setAxes(ShotFrame& frame);

// The map's place of an offset in front of the muzzle.
glm::vec2 mapOf(const ShotFrame& frame, const glm::vec3& q);

// A square of the map where one surface is hit, put onto that surface: its corners and the hit, as
// offsets from the muzzle, cut where they leave the cylinder.
struct Patch {
  glm::vec3 corners[4];
  glm::vec3 hit;
  glm::vec4 plane;      // normal towards the muzzle; its product with offsets on the surface
  bool ragged = false;  // a square beside it sees another surface
};

struct ShotMap {
  ShotFrame frame;
  uint32_t root = kOpen;
  std::vector<uint32_t> blocks;  // four words each
  std::vector<Patch> patches;    // within range
};

enum class MapState : uint8_t { kSeen, kUnknown, kNoRays };

// Casts what it takes: some 1,500 rays for a wall, 20,000 for a plant. kUnknown: the host cannot
// tell now; `map` is unusable then. `range` in metres, over 0. `direction` unit.
MapState seeFrom(const grisaille_shot& shot, float range, const CastRays& cast, ShotMap& map);

// Whether the muzzle sees the point at offset q on a facet with this normal, which lies in the
// cylinder and faces the muzzle.
bool inSight(const ShotFrame& frame, uint32_t root, const uint32_t* blocks, const glm::vec3& q,
             const glm::vec3& facing);

}  // namespace grisaille::sspm
