// SPDX-License-Identifier: MIT
// The ray-traced ambient occlusion of one picture, traced or read from the cache.
#pragma once

#include <string>
#include <vector>

#include "app/truth/progress.h"
#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::app::truth {

// Default seed of the sample points.
constexpr uint32_t kSeed = 1;

// The cache key of an estimate: everything that its counts depend on. `scene`: its hashOf().
// `camera`: with the picture's size.
std::string keyOf(const std::string& estimate, uint64_t scene, const scene::Camera& camera,
                  double radius, uint32_t seed);

struct OcclusionTruth {
  image::Image visibility;       // one channel
  std::vector<trace::Hit> hits;  // by rows; a view depth of 0: sky
  double error = 0;              // rms standard error of the visibility
};

// Traces the same as `grisaille truth --write ao=...`, with its cache and its default seed.
// `radius`: length of the rays, metres. `samples`: rays per pixel. `name`: for the progress bar.
// Throws Interrupted.
OcclusionTruth traceOcclusion(const scene::Scene& scene, const scene::Camera& camera,
                              glm::uvec2 size, double radius, uint32_t samples,
                              ProgressStyle progress, const std::string& name = "truth");

}  // namespace grisaille::app::truth
