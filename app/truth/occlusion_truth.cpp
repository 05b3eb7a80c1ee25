// SPDX-License-Identifier: MIT
#include "app/truth/occlusion_truth.h"

#include <fmt/format.h>

#include "app/truth/content_hash.h"
#include "app/truth/refine.h"

namespace grisaille::app::truth {
namespace {

// Part of every key. Increase it with every change of the code that changes the counts.
constexpr int kTracing = 1;

}  // namespace

std::string keyOf(const std::string& estimate, uint64_t scene, const scene::Camera& camera,
                  double radius, uint32_t seed) {
  return fmt::format("grisaille {} {}\nscene {:016x}\ncamera {}\nradius {}\nseed {}\n", estimate,
                     kTracing, scene, scene::cameraJson(camera), radius, seed);
}

OcclusionTruth traceOcclusion(const scene::Scene& scene, const scene::Camera& camera,
                              glm::uvec2 size, double radius, uint32_t samples,
                              ProgressStyle progress, const std::string& name) {
  scene::Camera sized = camera;
  sized.size = size;
  const trace::RayTracer tracer(scene, camera.eye);
  OcclusionTruth truth;
  truth.hits = tracer.castPrimary(camera, size.x, size.y);
  Cache cache(cacheFolder(), keyOf("ao", hashOf(scene), sized, radius, kSeed));
  const Estimate estimate = refine(
      name, truth.hits,
      [&](auto hits, uint32_t from, uint32_t to, auto counts) {
        tracer.addOcclusion(hits, radius, kSeed, from, to, counts);
      },
      {.samples = samples, .error = 0}, cache, progress);
  truth.visibility = trace::visibilityImage(estimate.values, size.x, size.y);
  truth.error = estimate.error;
  return truth;
}

}  // namespace grisaille::app::truth
