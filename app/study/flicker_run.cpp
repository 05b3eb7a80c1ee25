// SPDX-License-Identifier: MIT
#include "app/study/flicker_run.h"

#include <limits>

#include "app/truth/occlusion_truth.h"
#include "core/base/error.h"

namespace grisaille::app::study {

void checkPathSize(const std::string& name, size_t frames, glm::uvec2 size) {
  const uint64_t pixels = uint64_t{frames} * size.x * size.y;
  if (pixels > kMostPathPixels) {
    throw Error(ErrorId::kUsage, "{}: {} frames of {}x{} are {} pixels; at most {} are possible",
                name, frames, size.x, size.y, pixels, kMostPathPixels);
  }
}

trace::FlickerFrame traceFrame(const scene::Scene& scene, const scene::Camera& camera,
                               glm::uvec2 size, double radius, uint32_t samples,
                               truth::ProgressStyle progress) {
  truth::OcclusionTruth traced =
      truth::traceOcclusion(scene, camera, size, radius, samples, progress);
  trace::FlickerFrame frame{.camera = camera,
                            .hits = std::move(traced.hits),
                            .ao = {},
                            .truth = std::move(traced.visibility)};
  for (size_t i = 0; i < frame.hits.size(); ++i) {
    if (frame.hits[i].viewDepth == 0) {
      frame.truth.pixels[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return frame;
}

trace::Flicker flickerAlong(std::vector<trace::FlickerFrame>& frames, const ShowCamera& show) {
  for (trace::FlickerFrame& frame : frames) frame.ao = show(frame.camera);
  return trace::flicker(frames);
}

}  // namespace grisaille::app::study
