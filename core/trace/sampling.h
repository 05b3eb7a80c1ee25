// SPDX-License-Identifier: MIT
// Sample points that are the same on every machine: all steps except the last use integers.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

namespace grisaille::trace {

// An integer hash: every bit of the result depends on every bit of `x`. Constants: "lowbias32" of
// Wellons' search for integer hashes.
inline uint32_t hashBits(uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

inline uint32_t reverseBits(uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

// A nested uniform (Owen) scramble by hashing; constants of Burley, "Practical Hash-based Owen
// Scrambling", 2020.
inline uint32_t owenScramble(uint32_t x, uint32_t seed) {
  x = reverseBits(x) + seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reverseBits(x);
}

// Point `index` of the first two Sobol dimensions, scrambled; in [0, 1).
inline glm::vec2 sobolPoint(uint32_t index, uint32_t seed) {
  const uint32_t first = reverseBits(index);
  uint32_t second = 0;
  for (uint32_t bits = index, v = 1u << 31; bits != 0; bits >>= 1, v ^= v >> 1) {
    if ((bits & 1u) != 0) second ^= v;
  }
  const auto unit = [](uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; };
  return {unit(owenScramble(first, hashBits(seed))),
          unit(owenScramble(second, hashBits(seed ^ 0x9e3779b9u)))};
}

// Returns a right-handed frame whose third axis is the unit vector `n` (Duff et al., 2017).
inline glm::mat3 frameAbout(const glm::vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {glm::vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x),
          glm::vec3(b, sign + n.y * n.y * a, -n.y), n};
}

// Maps a point of [0, 1)^2 to a unit vector about +z with density cosine / pi: a point of the disc,
// projected up to the hemisphere (Malley).
inline glm::vec3 cosineDirection(const glm::vec2& point) {
  const float radius = std::sqrt(point.x);
  const float angle = 2.0f * std::numbers::pi_v<float> * point.y;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0f - point.x)};
}

}  // namespace grisaille::trace
