// SPDX-License-Identifier: MIT
// What shots of paint ought to cover, by rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/trace/ray_tracer.h"
#include "lab/paint/shot.h"

namespace grisaille::lab {

// One an element of `hits`: 1 where it lies less than a shot's range from the shot's ray, in front
// of its muzzle, faces it, and the segment to the muzzle is unblocked; else 0. `range`: metres, for
// shots without one. Segments begin 0.1 mm off the surface.
std::vector<uint8_t> paintMask(const trace::RayTracer& tracer, std::span<const trace::Hit> hits,
                               std::span<const Shot> shots, double range);

}  // namespace grisaille::lab
