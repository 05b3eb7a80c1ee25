// SPDX-License-Identifier: MIT
#include "lab/paint/paint_mask.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/trace/parallel.h"

namespace grisaille::lab {
namespace {

constexpr double kOff = 1e-4;  // metres between the surface and the segment's end
// More than what rounding adds to a distance, relative to it.
constexpr double kRounding = 1e-9;

// The segment from the muzzle to the surface; none if the shot cannot paint the hit.
std::optional<grisaille_ray> segment(const trace::Hit& hit, const Shot& shot, double range) {
  const glm::dvec3 muzzle(shot.origin[0], shot.origin[1], shot.origin[2]);
  const glm::dvec3 direction(shot.direction[0], shot.direction[1], shot.direction[2]);
  const glm::dvec3 q = hit.position - muzzle;
  if (glm::dot(q, direction) < 0 || glm::length(glm::cross(q, direction)) >= range) return {};
  if (glm::dot(hit.facetNormal, q) >= 0) return {};
  const glm::dvec3 way = hit.position + kOff * hit.facetNormal - muzzle;
  const double length = glm::length(way);
  const glm::vec3 unit(way / length);
  return grisaille_ray{.origin = {muzzle.x, muzzle.y, muzzle.z},
                       .direction = {unit.x, unit.y, unit.z},
                       .reach = static_cast<float>(length)};
}

// A sphere about the hits of a block.
struct Bounds {
  glm::dvec3 centre{0};
  double radius = -1;  // metres; negative: no hit
};

Bounds boundsOf(std::span<const trace::Hit> hits) {
  Bounds bounds;
  size_t count = 0;
  for (const trace::Hit& hit : hits) {
    if (hit.viewDepth == 0) continue;
    bounds.centre += hit.position;
    ++count;
  }
  if (count == 0) return bounds;
  bounds.centre /= static_cast<double>(count);
  for (const trace::Hit& hit : hits) {
    if (hit.viewDepth == 0) continue;
    bounds.radius = std::max(bounds.radius, glm::length(hit.position - bounds.centre));
  }
  return bounds;
}

// False only if no point within the bounds is in the shot's range and in front of its muzzle.
bool reaches(const Shot& shot, double range, const Bounds& bounds) {
  const glm::dvec3 muzzle(shot.origin[0], shot.origin[1], shot.origin[2]);
  const glm::dvec3 direction(shot.direction[0], shot.direction[1], shot.direction[2]);
  const glm::dvec3 q = bounds.centre - muzzle;
  const double away = bounds.radius * (1 + kRounding) + kRounding * (1 + glm::length(q));
  if (glm::dot(q, direction) < -away) return false;
  return glm::length(glm::cross(q, direction)) < range + away;
}

// Computes the owners of at most trace::kBlock pixels, from the newest shot to the oldest.
void paintBlock(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                std::span<const Shot> shots, double paintRange, std::span<uint32_t> owners) {
  std::array<grisaille_ray, trace::kBlock> rays;
  std::array<grisaille_hit, trace::kBlock> blocked;
  std::array<size_t, trace::kBlock> pixels;
  const Bounds bounds = boundsOf(hits);
  if (bounds.radius < 0) return;
  for (size_t s = shots.size(); s-- > 0;) {
    const Shot& shot = shots[s];
    const double range = shot.range > 0 ? double{shot.rangeOr(0)} : paintRange;
    if (!reaches(shot, range, bounds)) continue;
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      if (owners[i] != 0 || hits[i].viewDepth == 0) continue;
      const auto ray = segment(hits[i], shot, range);
      if (!ray) continue;
      rays[count] = *ray;
      pixels[count++] = i;
    }
    tracer.castRays(std::span(rays).first(count), std::span(blocked).first(count));
    for (size_t k = 0; k < count; ++k) {
      if (blocked[k].kind == GRISAILLE_HIT_NONE) owners[pixels[k]] = static_cast<uint32_t>(s + 1);
    }
  }
}

}  // namespace

std::vector<uint32_t> paintOwners(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                                  std::span<const Shot> shots, double range) {
  std::vector<uint32_t> owners(hits.size(), 0);
  trace::forEachBlock(hits.size(), [&](size_t first, size_t count) {
    paintBlock(tracer, hits.subspan(first, count), shots, range,
               std::span(owners).subspan(first, count));
  });
  return owners;
}

std::vector<uint8_t> paintMask(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                               std::span<const Shot> shots, double range) {
  const std::vector<uint32_t> owners = paintOwners(tracer, hits, shots, range);
  std::vector<uint8_t> mask(owners.size());
  std::ranges::transform(owners, mask.begin(), [](uint32_t owner) { return owner != 0 ? 1 : 0; });
  return mask;
}

}  // namespace grisaille::lab
