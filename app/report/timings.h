// SPDX-License-Identifier: MIT
// --timings: the time of every pass of every frame, as CSV.
#pragma once

#include <span>
#include <string>

#include "core/gpu/types.h"

namespace grisaille::app {

// CSV with the header "frame,effect,pass,milliseconds,clock". A pass labelled "ssao/blur" has the
// effect "ssao" and the pass "blur"; a label without '/' has the effect "".
std::string timingsCsv(std::span<const gpu::FrameTimes> frames, gpu::Clock clock);

// A warning if, in any frame, the sum of the passes' times differs from the frame's time by more
// than 5 %; else "".
std::string timingsDoubt(std::span<const gpu::FrameTimes> frames);

}  // namespace grisaille::app
