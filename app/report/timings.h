// SPDX-License-Identifier: MIT
// --timings: what every pass of every frame took, as CSV.
#pragma once

#include <span>
#include <string>

#include "core/gpu/types.h"

namespace grisaille::app {

// Header "frame,effect,pass,milliseconds,clock". A pass labelled "ssao/blur" is effect "ssao", pass
// "blur".
std::string timingsCsv(std::span<const gpu::FrameTimes> frames, gpu::Clock clock);

// A sentence when the passes of any frame sum to something that differs from its whole by more than
// 5 %, else "".
std::string timingsDoubt(std::span<const gpu::FrameTimes> frames);

}  // namespace grisaille::app
