// SPDX-License-Identifier: MIT
// Measures how closely drivers agree: on effects with the same depth and normals as input, and on
// whole frames that each driver draws itself.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/effect/chain.h"
#include "core/frame/picture_attachments.h"
#include "core/frame/renderer.h"
#include "core/trace/ray_tracer.h"
#include "lab/paint/shot.h"
#include "tests/support/devices.h"
#include "tests/support/traced_rays.h"

namespace grisaille::tests {

// A view of a scene, with shots to place in it and truth to compare with.
class DriverSubject {
 public:
  // The built-in atrium, or Crytek Sponza from GRISAILLE_SPONZA or the project's folder. sponza()
  // returns null if the file is missing.
  static std::unique_ptr<DriverSubject> atrium(uint32_t width, uint32_t height);
  static std::unique_ptr<DriverSubject> sponza(uint32_t width, uint32_t height);

  // RMSE of a visibility picture against ray casts, at every second pixel in both directions.
  struct Errors {
    double whole = 0;
    // Only pixels with a drawn depth within 1 % of the ray's. Other pixels, at edges, show another
    // surface than the ray through their centre hits.
    double sameSurface = 0;
    double otherSurface = 0;  // share of pixels
  };
  Errors errors(const image::Image& ao, const image::Image& depth);

  std::string name;
  scene::Scene scene;
  scene::Camera camera;
  uint32_t width = 0, height = 0;  // pixels
  std::unique_ptr<TracedRays> rays;
  std::vector<lab::Shot> shots;  // from around the camera, at surfaces that it sees

 private:
  DriverSubject(std::string name, scene::Scene scene, const scene::Camera& camera, uint32_t width,
                uint32_t height);
  void traceTruth();

  std::vector<trace::Hit> truthHits_;
  std::vector<trace::Visibility> truth_;  // traced by the first errors()
};

// The attachments of one view, drawn by one driver.
struct SharedAttachments {
  frame::Pictures pictures;  // without base colours
  image::Image backDepth, nextDepth;
};
SharedAttachments drawShared(gpu::Device& device, const DriverSubject& subject);

struct PresetOf {
  std::string effect;  // key
  std::string preset;  // name
};
// A selection of this effect alone, with the preset's values.
effect::Selection selectionOf(const effect::Registry& registry, const PresetOf& preset);
// All presets of both effects.
std::vector<PresetOf> allPresets(const effect::Registry& registry);

// The output that is compared for an effect: "ao" or "paint".
std::string outputOf(const std::string& effect);

// Renders that output on a device from the shared attachments. `grisaille apply` hands the same
// inputs to an effect, except shots and the depth of back faces.
image::Image applyShared(gpu::Device& device, const DriverSubject& subject,
                         const effect::Selection& selection, const SharedAttachments& shared);

// That output and "depth", from a frame that the device draws itself.
std::pair<image::Image, image::Image> drawWhole(gpu::Device& device, const DriverSubject& subject,
                                                const effect::Selection& selection);

// Share of pixels with a channel that differs by more than 2/255. Both pictures have the same size.
double shareApart(const image::Image& a, const image::Image& b);

}  // namespace grisaille::tests
