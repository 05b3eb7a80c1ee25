// SPDX-License-Identifier: MIT
#include "lab/oracle/paint.h"

#include <algorithm>
#include <cmath>

namespace grisaille::lab::oracle {
namespace {

uint32_t hash(uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

// Uniform in [0, 1) at a lattice point.
double corner(int64_t x, int64_t y, int64_t z, uint32_t seed) {
  const uint32_t bits = static_cast<uint32_t>(x) * 0x9e3779b1u ^
                        static_cast<uint32_t>(y) * 0x85ebca77u ^
                        static_cast<uint32_t>(z) * 0xc2b2ae3du ^ seed;
  return (hash(bits) >> 8) / 16777216.0;
}

double quintic(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

double valueNoise(const glm::dvec3& place, uint32_t seed) {
  const glm::dvec3 whole = glm::floor(place);
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    double weight = 1;
    int64_t at[3];
    for (int axis = 0; axis < 3; ++axis) {
      const int step = i >> axis & 1;
      const double t = quintic(place[axis] - whole[axis]);
      weight *= step != 0 ? t : 1 - t;
      at[axis] = static_cast<int64_t>(whole[axis]) + step;
    }
    sum += weight * corner(at[0], at[1], at[2], seed);
  }
  return sum;
}

}  // namespace

double splatNoise(const glm::dvec3& world, double pixelSize, const PaintSettings& settings) {
  double sum = 0, weights = 0;
  for (uint32_t octave = 0; octave < 3; ++octave) {
    const double cell = settings.splatScale / std::exp2(octave);
    const double weight = 1 / std::exp2(octave);
    const double shown = std::clamp(cell / (2 * pixelSize) - 1, 0.0, 1.0);
    const uint32_t seed = (settings.noiseSeed * 3 + octave) * 0x27d4eb2fu;
    sum += weight * shown * (valueNoise(world / cell, seed) - 0.5);
    weights += weight;
  }
  return 0.9 * std::clamp(0.5 + 2 * sum / weights, 0.0, 1.0);
}

PaintPixel paintOf(const glm::dvec3& world, double viewDepth, double pixelSize,
                   std::span<const Shot> shots, const PaintSettings& settings,
                   const std::optional<Sight>& sight) {
  PaintPixel pixel;
  if (viewDepth == 0) return pixel;
  glm::dvec3 color(0);
  double alphas = 0;
  const size_t kept = sight ? shots.size() : std::min(shots.size(), settings.shotLimit);
  for (const Shot& shot : shots.last(kept)) {
    const glm::dvec3 q = world - glm::dvec3(shot.origin[0], shot.origin[1], shot.origin[2]);
    const glm::dvec3 direction(shot.direction[0], shot.direction[1], shot.direction[2]);
    const double range = shot.range > 0 ? double{shot.rangeOr(0)} : settings.paintRange;
    const double distance = glm::length(glm::cross(q, direction));
    if (glm::dot(q, direction) < 0 || distance >= range) continue;
    if (sight && !(glm::dot(q, sight->facet) < 0)) continue;
    if (sight && sight->sees && !sight->sees(shot)) continue;
    const double alpha = std::min(1.0, settings.full / std::max(distance, 1e-6));
    const double fade =
        settings.edgeFade > 0 ? std::min(1.0, (1 - distance / range) / settings.edgeFade) : 1.0;
    color = glm::mix(color, glm::dvec3(shot.color[0], shot.color[1], shot.color[2]), alpha);
    alphas += alpha * fade;
  }
  pixel.coverage = std::min(alphas, 1.0);
  if (pixel.coverage <= 0) return pixel;
  const double above = pixel.coverage - splatNoise(world, pixelSize, settings);
  const double half = 0.5 * (1 - settings.splatSharpness);
  double alpha = above > 0 ? 1 : 0;
  if (half > 0) {
    const double t = std::clamp((above + half) / (2 * half), 0.0, 1.0);
    alpha = t * t * (3 - 2 * t) * std::min(pixel.coverage / half, 1.0);
  }
  if (alpha > 0) pixel.paint = glm::dvec4(color, alpha);
  return pixel;
}

}  // namespace grisaille::lab::oracle
