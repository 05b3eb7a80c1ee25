// SPDX-License-Identifier: MIT
#include "lab/claims/screen_splats.h"

#include <algorithm>
#include <cmath>

namespace grisaille::lab::claims {
namespace {

constexpr uint32_t kOctaves = 2;

// A hash of three numbers, uniform in [0, 1).
double hashUnit(int64_t x, int64_t y, uint64_t seed) {
  uint64_t bits = static_cast<uint64_t>(x) * 0x9e3779b97f4a7c15u ^
                  static_cast<uint64_t>(y) * 0xc2b2ae3d27d4eb4fu ^ seed * 0x165667b19e3779f9u;
  bits = (bits ^ (bits >> 31)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 29)) * 0x94d049bb133111ebu;
  return static_cast<double>((bits ^ (bits >> 32)) >> 11) * 0x1p-53;
}

double smooth(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

// Value noise; x and y in cells.
double valueNoise(double x, double y, uint64_t seed) {
  const double cellX = std::floor(x), cellY = std::floor(y);
  const double u = smooth(x - cellX), v = smooth(y - cellY);
  const auto corner = [&](int dx, int dy) {
    return hashUnit(static_cast<int64_t>(cellX) + dx, static_cast<int64_t>(cellY) + dy, seed);
  };
  const double top = std::lerp(corner(0, 0), corner(1, 0), u);
  return std::lerp(top, std::lerp(corner(0, 1), corner(1, 1), u), v);
}

// The squared distance from the drop of a cell, in its radii; x and y in cells.
double dropNoise(double x, double y, uint64_t seed) {
  const double cellX = std::floor(x), cellY = std::floor(y);
  const auto unit = [&](uint64_t which) {
    return hashUnit(static_cast<int64_t>(cellX), static_cast<int64_t>(cellY), ~seed * 3 + which);
  };
  const double size = unit(0), radius = 0.06 + 0.34 * size * size;
  const double centreX = std::lerp(radius, 1 - radius, unit(1));
  const double centreY = std::lerp(radius, 1 - radius, unit(2));
  return (std::pow(x - cellX - centreX, 2) + std::pow(y - cellY - centreY, 2)) / (radius * radius);
}

double noiseAt(double x, double y, const ScreenSplats& splats) {
  double sum = 0, weights = 0, drop = 1;
  for (uint32_t octave = 0; octave < kOctaves; ++octave) {
    const double weight = std::pow(0.35, octave),
                 cell = splats.cell * std::exp2(-static_cast<double>(octave));
    const double shown = std::clamp(cell / 2 - 1, 0.0, 1.0), drops = 1.6 * cell;
    const double visible = std::clamp(drops / 4 - 1, 0.0, 1.0);
    const uint64_t seed = uint64_t{splats.seed} * kOctaves + octave;
    if (shown > 0) sum += weight * shown * (valueNoise(x / cell, y / cell, seed) - 0.5);
    drop = std::min(drop, std::lerp(1.0, dropNoise(x / drops, y / drops, seed), visible));
    weights += weight;
  }
  const double rise = std::clamp(0.5 + 1.7 * sum / weights, 0.0, 1.0);
  return 0.9 * std::min(0.2 + 0.8 * rise * rise * (3 - 2 * rise), drop);
}

double alphaOf(double coverage, double noise, double sharpness) {
  if (coverage <= 0) return 0;
  const double half = (1 - sharpness) / 2, above = coverage - noise;
  if (half <= 0) return above > 0 ? 1 : 0;
  const double t = std::clamp((above + half) / (2 * half), 0.0, 1.0);
  return t * t * (3 - 2 * t) * std::min(coverage / half, 1.0);
}

}  // namespace

image::Image screenSplats(const image::Image& coverage, const ScreenSplats& splats) {
  image::Image alpha = coverage;
  for (size_t i = 0; i < alpha.pixels.size(); ++i) {
    const double x = static_cast<double>(i % alpha.width) + 0.5;
    const double y = static_cast<double>(i / alpha.width) + 0.5;
    alpha.pixels[i] = static_cast<float>(
        alphaOf(double{coverage.pixels[i]}, noiseAt(x, y, splats), splats.sharpness));
  }
  return alpha;
}

}  // namespace grisaille::lab::claims
