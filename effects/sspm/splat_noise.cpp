// SPDX-License-Identifier: MIT
#include "splat_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace grisaille::sspm {
namespace {

uint32_t hashBits(uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

// Uniform in [0, 1).
float unitOf(uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

// Cells of lobes: shaders/sspm/splat.glsl.
constexpr double kAlong = 0.4, kDropCells = 1.6;
constexpr float kNextOctave = 0.35f;

float valueNoise(const glm::dvec2& place, uint32_t seed) {
  const glm::dvec2 whole = glm::floor(place);
  const glm::vec2 f(place - whole);
  const glm::vec2 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  const glm::uvec2 primes(0x9e3779b1u, 0x85ebca77u);
  const glm::uvec2 low = glm::uvec2(glm::ivec2(whole)) * primes, high = low + primes;
  const auto along = [&](uint32_t y) {
    return glm::mix(unitOf(hashBits(low.x ^ y ^ seed)), unitOf(hashBits(high.x ^ y ^ seed)), w.x);
  };
  return glm::mix(along(low.y), along(high.y), w.y);
}

float dropNoise(const glm::dvec2& place, uint32_t seed) {
  const glm::dvec2 whole = glm::floor(place);
  const glm::uvec2 cell = glm::uvec2(glm::ivec2(whole)) * glm::uvec2(0x9e3779b1u, 0x85ebca77u);
  const uint32_t bits = hashBits(cell.x ^ cell.y ^ seed ^ 0x51ed270bu);
  const float size = static_cast<float>(bits & 255u) / 256;
  const float radius = 0.06f + 0.34f * size * size;
  const glm::vec2 part = glm::vec2(bits >> 8 & 4095u, bits >> 20) / 4096.0f;
  const glm::vec2 centre = glm::mix(glm::vec2(radius), glm::vec2(1 - radius), part);
  const glm::vec2 apart = (glm::vec2(place - whole) - centre) / radius;
  return glm::dot(apart, apart);
}

}  // namespace

uint32_t splatSeed(const Shot& shot, uint32_t noiseSeed) {
  constexpr uint32_t kOfFraction[] = {0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du};
  constexpr uint32_t kOfDirection[] = {0x165667b1u, 0xd3a2646du, 0xfd7046c5u};
  uint32_t bits = noiseSeed * 0x27d4eb2fu;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double fraction = shot.origin[axis] - std::round(shot.origin[axis]);
    bits ^= std::bit_cast<uint32_t>(static_cast<float>(fraction)) * kOfFraction[axis];
    bits ^= std::bit_cast<uint32_t>(shot.direction[axis]) * kOfDirection[axis];
  }
  return hashBits(bits);
}

float Splat::noiseAt(uint32_t of, const glm::dvec2& across, double middle) const {
  const double t = double{unitOf(hashBits(of ^ 0x68bc21ebu))};
  const glm::dvec2 turn = glm::dvec2(1 - t * t, 2 * t) / (1 + t * t);
  const glm::dvec2 cells(
      glm::dvec2(turn.x * across.x - turn.y * across.y, turn.y * across.x + turn.x * across.y) /
      scale);
  const double outward = kAlong + (1 - kAlong) * middle / std::max(glm::length(across), 1e-6);
  glm::dvec2 lobes = outward * cells, drops = cells / kDropCells;
  float sum = 0, weight = 1, drop = 1;
  for (uint32_t octave = 0; octave < kOctaves; ++octave) {
    const uint32_t seedOf = of + octave * 0x27d4eb2fu;
    sum += weight * (valueNoise(glm::clamp(lobes, -1e9, 1e9), seedOf) - 0.5f);
    drop = std::min(drop, dropNoise(glm::clamp(drops, -1e9, 1e9), seedOf));
    weight *= kNextOctave;
    lobes = glm::dvec2(1.6 * lobes.x - 1.2 * lobes.y, 1.2 * lobes.x + 1.6 * lobes.y);
    drops = glm::dvec2(1.6 * drops.x - 1.2 * drops.y, 1.2 * drops.x + 1.6 * drops.y);
  }
  const float lobe = glm::smoothstep(0.0f, 1.0f, 0.5f + 1.7f / (1 + kNextOctave) * sum);
  return 0.9f * std::min(glm::mix(0.2f, 1.0f, lobe), drop);
}

float Splat::alphaOf(float strength, float noise) const {
  if (strength <= 0) return 0;
  const float above = strength - noise;
  if (halfWidth <= 0) return above > 0 ? 1.0f : 0.0f;
  return glm::smoothstep(-halfWidth, halfWidth, above) * std::min(strength / halfWidth, 1.0f);
}

}  // namespace grisaille::sspm
