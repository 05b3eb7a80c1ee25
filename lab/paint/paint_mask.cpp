// SPDX-License-Identifier: MIT
#include "lab/paint/paint_mask.h"

#include <array>
#include <optional>

#include "core/trace/parallel.h"

namespace grisaille::lab {
namespace {

constexpr double kOff = 1e-4;  // metres between the surface and the segment's end

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

// Computes the mask of at most trace::kBlock pixels.
void paintBlock(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                std::span<const Shot> shots, double range, std::span<uint8_t> mask) {
  std::array<grisaille_ray, trace::kBlock> rays;
  std::array<grisaille_hit, trace::kBlock> blocked;
  std::array<size_t, trace::kBlock> owners;
  for (const Shot& shot : shots) {
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      if (mask[i] != 0 || hits[i].viewDepth == 0) continue;
      const auto ray = segment(hits[i], shot, shot.range > 0 ? double{shot.rangeOr(0)} : range);
      if (!ray) continue;
      rays[count] = *ray;
      owners[count++] = i;
    }
    tracer.castRays(std::span(rays).first(count), std::span(blocked).first(count));
    for (size_t k = 0; k < count; ++k) {
      if (blocked[k].kind == GRISAILLE_HIT_NONE) mask[owners[k]] = 1;
    }
  }
}

}  // namespace

std::vector<uint8_t> paintMask(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                               std::span<const Shot> shots, double range) {
  std::vector<uint8_t> mask(hits.size(), 0);
  trace::forEachBlock(hits.size(), [&](size_t first, size_t count) {
    paintBlock(tracer, hits.subspan(first, count), shots, range,
               std::span(mask).subspan(first, count));
  });
  return mask;
}

}  // namespace grisaille::lab
