// SPDX-License-Identifier: MIT
// Measures how much a setting flickers along a camera path, with trace::flicker().
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/truth/progress.h"
#include "core/scene/camera_path.h"
#include "core/trace/flicker.h"

namespace grisaille::app::study {

// Limit of frames times pixels of a path. Each pixel takes about 130 bytes of memory.
constexpr uint64_t kMostPathPixels = 1 << 24;

// Throws kUsage if the path exceeds kMostPathPixels. `name`: for the message.
void checkPathSize(const std::string& name, size_t frames, glm::uvec2 size);

// Traces the truth of one camera with truth::traceOcclusion(): one channel, NaN at pixels without a
// surface. Leaves `ao` empty. `radius`: metres. `samples`: rays per pixel. Throws Interrupted.
trace::FlickerFrame traceFrame(const scene::Scene& scene, const scene::Camera& camera,
                               glm::uvec2 size, double radius, uint32_t samples,
                               truth::ProgressStyle progress);

// Renders a setting from a camera. Returns one channel.
using ShowCamera = std::function<image::Image(const scene::Camera&)>;

// Renders every frame into its `ao`, and returns the flicker.
trace::Flicker flickerAlong(std::vector<trace::FlickerFrame>& frames, const ShowCamera& show);

}  // namespace grisaille::app::study
