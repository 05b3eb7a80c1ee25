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
//   normal towards the muzzle. The muzzle sees points in front of that plane. A line may divide a
//   leaf between two planes: a silhouette, or a crease.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "grisaille/effect.h"
#include "shot.h"

namespace grisaille::sspm {

constexpr float kMapReach = 8;  // the map spans [-8, 8] on both axes

// A reference within the map, 16 bits: a tag, and an offset in blocks of two 32-bit words from the
// map's start; for a plane, the offset + 1. Same as in shaders/sspm/walk.glsl.
//
// A node has 4x4 squares, by rows. With few different references, it holds each once, after an
// index for each square: of 1, 2 or 3 bits. Indices of 3 bits fill 30 bits of the first word, then
// 18 of the second. References are halves of words, the lower half first.
constexpr uint32_t kOpen = 0;          // no surface in the cylinder; 1 and more: a plane, one block
constexpr uint32_t kLine = 0x2000;     // one block: see packLine()
constexpr uint32_t kTwo = 0x4000;      // one block: 16 indices of 1 bit, 2 references
constexpr uint32_t kFour = 0x6000;     // two blocks: 16 indices of 2 bits, 4 references
constexpr uint32_t kEight = 0x8000;    // three blocks: 16 indices of 3 bits, 8 references
constexpr uint32_t kSixteen = 0xA000;  // four blocks: 16 references
constexpr uint32_t kTag = 0xE000;
constexpr size_t kMostBlocks = 0x1FFE;

using MapBlock = std::array<uint32_t, 2>;

// Plane: xyz: unit normal, octahedral in two 16-bit snorms (Cigolla et al. 2014, "A Survey of
// Efficient Representations for Independent Unit Vectors"); w: dot(normal, q), a float.
MapBlock packPlane(const glm::vec4& plane);
glm::vec4 unpackPlane(const uint32_t* block);
// The normal that the map will hold for a normal.
glm::vec3 roundedNormal(const glm::vec3& normal);

// A line on the map: points with dot(normal, place) > offset are on its second side. The normal has
// |x| + |y| = 1.
struct MapLine {
  glm::vec2 normal = glm::vec2(0);
  float offset = 0;
};
// The line through two places, with `second` on its second side.
MapLine lineThrough(const glm::vec2& a, const glm::vec2& b, const glm::vec2& second);
// first, second: references to what lies on its sides.
MapBlock packLine(const MapLine& line, uint32_t first, uint32_t second);
MapLine unpackLine(const uint32_t* block);

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
  std::vector<uint32_t> words;  // two a block
};

// How far behind a plane a point is, in shares of what a map allows: at most 1 is in sight.
// plane: of a leaf. q: the point's offset. facing: the unit normal of its facet.
float depthBehind(const ShotFrame& frame, const glm::vec4& plane, const glm::vec3& q,
                  const glm::vec3& facing);

// Whether the muzzle sees the point at offset q. The point lies in the cylinder, on a facet that
// faces the muzzle.
// root, words: of the map. facing: the facet's unit normal.
bool inSight(const ShotFrame& frame, uint32_t root, const uint32_t* words, const glm::vec3& q,
             const glm::vec3& facing);

}  // namespace grisaille::sspm
