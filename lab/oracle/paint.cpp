// SPDX-License-Identifier: MIT
#include "lab/oracle/paint.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>

namespace grisaille::lab::oracle {
namespace {

constexpr uint32_t kOctaves = 2;
constexpr double kFill = 4;  // how steeply the strengths of several shots close gaps

uint32_t hash(uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

// Uniform in [0, 1).
double unitOf(uint32_t bits) {
  return (bits >> 8) / 16777216.0;
}

double corner(int64_t x, int64_t y, uint32_t seed) {
  return unitOf(
      hash(static_cast<uint32_t>(x) * 0x9e3779b1u ^ static_cast<uint32_t>(y) * 0x85ebca77u ^ seed));
}

double quintic(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

double valueNoise(const glm::dvec2& place, uint32_t seed) {
  const glm::dvec2 whole = glm::floor(place);
  const auto x = static_cast<int64_t>(whole.x), y = static_cast<int64_t>(whole.y);
  const double u = quintic(place.x - whole.x), v = quintic(place.y - whole.y);
  const double low = std::lerp(corner(x, y, seed), corner(x + 1, y, seed), u);
  return std::lerp(low, std::lerp(corner(x, y + 1, seed), corner(x + 1, y + 1, seed), u), v);
}

// The squared distance from the drop of a cell, in its radii.
double dropNoise(const glm::dvec2& place, uint32_t seed) {
  const glm::dvec2 whole = glm::floor(place);
  const auto x = static_cast<int64_t>(whole.x), y = static_cast<int64_t>(whole.y);
  const uint32_t bits = hash(static_cast<uint32_t>(x) * 0x9e3779b1u ^
                             static_cast<uint32_t>(y) * 0x85ebca77u ^ seed ^ 0x51ed270bu);
  const double size = (bits % 256) / 256.0, radius = 0.06 + 0.34 * size * size;
  const glm::dvec2 part((bits / 256 % 4096) / 4096.0, (bits / 1048576) / 4096.0);
  const glm::dvec2 apart = (place - whole - (radius + (1 - 2 * radius) * part)) / radius;
  return glm::dot(apart, apart);
}

uint32_t seedOf(const Shot& shot, uint32_t noiseSeed) {
  uint32_t bits = noiseSeed * 0x27d4eb2fu;
  constexpr uint32_t kPrimes[] = {0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du};
  constexpr uint32_t kOthers[] = {0x165667b1u, 0xd3a2646du, 0xfd7046c5u};
  for (int axis = 0; axis < 3; ++axis) {
    const double part = shot.origin[axis] - std::round(shot.origin[axis]);
    bits ^= std::bit_cast<uint32_t>(static_cast<float>(part)) * kPrimes[axis];
    bits ^= std::bit_cast<uint32_t>(shot.direction[axis]) * kOthers[axis];
  }
  return hash(bits);
}

// The splat's noise where a shot's ray passes at `q`, the offset from its muzzle. middle: distance
// of the rim's middle from the ray.
double splatNoise(const PaintLayer& layer, const glm::dvec3& q, double pixelSize, double middle,
                  const PaintSettings& settings) {
  const glm::dvec3 w(layer.shot.direction[0], layer.shot.direction[1], layer.shot.direction[2]);
  const double s = w.z >= 0 ? 1 : -1, a = -1 / (s + w.z), b = w.x * w.y * a;
  const glm::dvec3 right(1 + s * w.x * w.x * a, s * b, -s * w.x), up(b, s + w.y * w.y * a, -w.y);
  // A direction of floats is not exactly a unit vector, nor are the axes exactly across it: far
  // from the muzzle, what lies along the ray would leak into them.
  const glm::dvec3 beside = q - glm::dot(q, w) / glm::dot(w, w) * w;
  const glm::dvec2 across(glm::dot(beside, right), glm::dot(beside, up));
  const double t = unitOf(hash(layer.seed ^ 0x68bc21ebu));
  const double cosine = (1 - t * t) / (1 + t * t), sine = 2 * t / (1 + t * t);
  glm::dvec2 place(cosine * across.x - sine * across.y, sine * across.x + cosine * across.y);
  // Lobes are 2.5 times as long as wide at the middle of the rim.
  const double outward = 0.4 + 0.6 * middle / std::max(glm::length(across), 1e-6);
  double sum = 0, weights = 0, drop = 1;
  for (uint32_t octave = 0; octave < kOctaves; ++octave) {
    const double size = settings.splatScale / std::exp2(octave);
    const double lobe = size / outward, drops = 1.6 * size;
    const double weight = std::pow(0.35, octave);
    const double shown = std::clamp(lobe / (2 * pixelSize) - 1, 0.0, 1.0);
    const double visible = std::clamp(drops / (4 * pixelSize) - 1, 0.0, 1.0);
    const uint32_t seed = layer.seed + octave * 0x27d4eb2fu;
    const auto cells = [&](double cell) { return glm::clamp(place / cell, -1e9, 1e9); };
    if (shown > 0) sum += weight * shown * (valueNoise(cells(lobe), seed) - 0.5);
    if (visible > 0) drop = std::min(drop, std::lerp(1.0, dropNoise(cells(drops), seed), visible));
    weights += weight;
    place = glm::dvec2(0.8 * place.x - 0.6 * place.y, 0.6 * place.x + 0.8 * place.y);
  }
  const double rise = std::clamp(0.5 + 1.7 * sum / weights, 0.0, 1.0);
  return 0.9 * std::min(0.2 + 0.8 * rise * rise * (3 - 2 * rise), drop);
}

double splatAlpha(double strength, double noise, double sharpness) {
  if (strength <= 0) return 0;
  const double above = strength - noise, half = 0.5 * (1 - sharpness);
  if (half <= 0) return above > 0 ? 1 : 0;
  const double t = std::clamp((above + half) / (2 * half), 0.0, 1.0);
  return t * t * (3 - 2 * t) * std::min(strength / half, 1.0);
}

}  // namespace

std::vector<PaintLayer> layersOf(std::span<const Shot> shots, const PaintSettings& settings,
                                 bool limited) {
  if (limited) shots = shots.last(std::min(shots.size(), settings.shotLimit));
  std::vector<PaintLayer> layers;
  using Ray = std::tuple<double, double, double, float, float, float, double>;
  std::map<Ray, size_t> newest;
  for (size_t i = shots.size(); i-- > 0;) {
    const Shot& shot = shots[i];
    const auto [it, added] =
        newest.try_emplace({shot.origin[0], shot.origin[1], shot.origin[2], shot.direction[0],
                            shot.direction[1], shot.direction[2], shot.range},
                           layers.size());
    if (added) {
      layers.push_back({.shot = shot, .seed = seedOf(shot, settings.noiseSeed)});
    } else {
      ++layers[it->second].times;
    }
  }
  return layers;
}

PaintPixel paintOf(const glm::dvec3& world, double viewDepth, double pixelSize,
                   std::span<const PaintLayer> layers, const PaintSettings& settings,
                   const std::optional<Sight>& sight) {
  PaintPixel pixel;
  if (viewDepth == 0) return pixel;
  glm::dvec3 color(0);
  double sum = 0, covered = 0;
  for (const PaintLayer& layer : layers) {
    const Shot& shot = layer.shot;
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
    const double strength = std::min(layer.times * alpha * fade, 1.0);
    sum += strength;
    const double filled = std::clamp(1 - kFill * (1 - sum), strength, 1.0);
    const double middle = range * (1 - 0.5 * settings.edgeFade);
    const double noise = splatNoise(layer, q, pixelSize, middle, settings);
    const double shown = splatAlpha(filled, noise, settings.splatSharpness);
    if (shown > covered) {
      color += (shown - covered) * glm::dvec3(shot.color[0], shot.color[1], shot.color[2]);
      covered = shown;
    }
    if (sum >= 1) break;
  }
  pixel.coverage = std::min(sum, 1.0);
  if (covered > 0) pixel.paint = glm::dvec4(color / covered, covered);
  return pixel;
}

}  // namespace grisaille::lab::oracle
