// SPDX-License-Identifier: MIT
// How much a setting flickers along a camera path: trace::flicker() of what it shows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/truth/progress.h"
#include "core/scene/camera_path.h"
#include "core/trace/flicker.h"

namespace grisaille::app::study {

// Frames times pixels of a path: each takes some 130 bytes of memory.
constexpr uint64_t kMostPathPixels = 1 << 24;

// Throws kUsage where the path has more pixels than that; `name` is for the message.
void checkPathSize(const std::string& name, size_t frames, glm::uvec2 size);

// The truth of one camera, as truth::traceOcclusion() has it: one channel, NaN where there is no
// surface. `ao` is empty. Throws Interrupted.
trace::FlickerFrame traceFrame(const scene::Scene& scene, const scene::Camera& camera,
                               glm::uvec2 size, double radius, uint32_t samples,
                               truth::ProgressStyle progress);

// What a setting shows of a camera, one channel.
using ShowCamera = std::function<image::Image(const scene::Camera&)>;

// Shows every frame and keeps the pictures as the frames' `ao`.
trace::Flicker flickerAlong(std::vector<trace::FlickerFrame>& frames, const ShowCamera& show);

}  // namespace grisaille::app::study
