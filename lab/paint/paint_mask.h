// SPDX-License-Identifier: MIT
// The ray-traced mask of paint: where shots should paint.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/trace/ray_tracer.h"
#include "lab/paint/shot.h"

namespace grisaille::lab {

// Returns one value per element of `hits`. It is 1 if for any shot the hit lies less than the
// shot's range from its ray, in front of its muzzle, faces the muzzle, and nothing blocks the
// segment to the muzzle; else 0. `range`: for shots without one, in metres. Segments start 0.1 mm
// off the surface.
std::vector<uint8_t> paintMask(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                               std::span<const Shot> shots, double range);

}  // namespace grisaille::lab
