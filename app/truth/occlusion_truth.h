// SPDX-License-Identifier: MIT
// The truth of one picture's ambient occlusion, traced or taken from the cache.
#pragma once

#include <string>
#include <vector>

#include "app/truth/progress.h"
#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::app::truth {

// Of the sample points, unless the user gives another.
constexpr uint32_t kSeed = 1;

// All that the counts of an estimate depend on; `camera` with the picture's size. `scene`: its
// hashOf().
std::string keyOf(const std::string& estimate, uint64_t scene, const scene::Camera& camera,
                  double radius, uint32_t seed);

struct OcclusionTruth {
  image::Image visibility;       // one channel
  std::vector<trace::Hit> hits;  // by rows; of the sky with a view depth of 0
  double error = 0;              // rms standard error of the visibility
};

// As `grisaille truth --write ao=...` has it, with its cache and the same seed. `name` is for the
// progress bar. Throws Interrupted.
OcclusionTruth traceOcclusion(const scene::Scene& scene, const scene::Camera& camera,
                              glm::uvec2 size, double radius, uint32_t samples,
                              ProgressStyle progress, const std::string& name = "truth");

}  // namespace grisaille::app::truth
