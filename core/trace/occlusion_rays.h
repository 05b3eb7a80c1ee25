// SPDX-License-Identifier: MIT
// The directions of occlusion rays, shared by all tests of what blocks a ray.
#pragma once

#include "core/trace/occlusion.h"
#include "core/trace/ray_tracer.h"
#include "core/trace/sampling.h"

namespace grisaille::trace {

// Adds the rays `from` ... `to` - 1 of a surface pixel to `counts`. Rays are cosine-weighted about
// the interpolated normal. isOpen(direction) returns whether the ray in a unit direction, in world
// axes, is open; it is not called for rays below the facet.
template <typename IsOpen>
void countRays(const Hit& hit, uint32_t seed, uint32_t from, uint32_t to, OcclusionCounts& counts,
               const IsOpen& isOpen) {
  const glm::vec3 facetNormal(hit.facetNormal);
  const glm::mat3 frame = frameAbout(hit.normal);
  const uint32_t pixel = hashBits(hit.pixel.x + hashBits(hit.pixel.y + hashBits(seed)));
  std::array<uint32_t, kScrambles> scrambles;
  for (uint32_t k = 0; k < kScrambles; ++k) scrambles[k] = hashBits(pixel + k);
  for (uint32_t ray = from; ray < to; ++ray) {
    const uint32_t k = ray % kScrambles;
    const glm::vec3 direction = frame * cosineDirection(sobolPoint(ray / kScrambles, scrambles[k]));
    if (glm::dot(direction, facetNormal) <= 0) continue;
    ++counts.counted[k];
    if (isOpen(direction)) ++counts.open[k];
  }
}

}  // namespace grisaille::trace
