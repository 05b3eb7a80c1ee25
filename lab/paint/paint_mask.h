// SPDX-License-Identifier: MIT
// The ray-traced mask of paint: where shots should paint.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/trace/ray_tracer.h"
#include "lab/paint/shot.h"

namespace grisaille::lab {

// Returns one value per element of `hits`: 1 + the index of the newest (last) shot that paints the
// hit, 0 if none does. A shot paints a hit that lies less than the shot's range from its ray, in
// front of its muzzle, and faces the muzzle, if nothing blocks the segment to the muzzle. `range`:
// for shots without one, in metres. Segments start 0.1 mm off the surface.
std::vector<uint32_t> paintOwners(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                                  std::span<const Shot> shots, double range);

// Returns 1 for each hit that a shot paints, 0 for the others. Parameters as for paintOwners().
std::vector<uint8_t> paintMask(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                               std::span<const Shot> shots, double range);

}  // namespace grisaille::lab
