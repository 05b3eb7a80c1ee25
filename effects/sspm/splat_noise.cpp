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

float Splat::noiseAt(uint32_t of, const glm::dvec2& across) const {
  const double t = double{unitOf(hashBits(of ^ 0x68bc21ebu))};
  const glm::dvec2 turn = glm::dvec2(1 - t * t, 2 * t) / (1 + t * t);
  glm::dvec2 place =
      glm::dvec2(turn.x * across.x - turn.y * across.y, turn.y * across.x + turn.x * across.y) /
      scale;
  float sum = 0, weight = 1, weights = 0;
  for (uint32_t octave = 0; octave < kOctaves; ++octave) {
    const float value = valueNoise(glm::clamp(place, -1e9, 1e9), of + octave * 0x27d4eb2fu);
    sum += weight * (value - 0.5f);
    weights += weight;
    weight *= 0.5f;
    place = glm::dvec2(1.6 * place.x - 1.2 * place.y, 1.2 * place.x + 1.6 * place.y);
  }
  return 0.9f * std::clamp(0.5f + 2 * sum / weights, 0.0f, 1.0f);
}

float Splat::alphaOf(float strength, float noise) const {
  if (strength <= 0) return 0;
  const float above = strength - noise;
  if (halfWidth <= 0) return above > 0 ? 1.0f : 0.0f;
  return glm::smoothstep(-halfWidth, halfWidth, above) * std::min(strength / halfWidth, 1.0f);
}

}  // namespace grisaille::sspm
