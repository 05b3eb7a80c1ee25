// SPDX-License-Identifier: MIT
// Measures how much an effect's picture changes along a camera path where the truth does not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::trace {

// One frame of the path. All frames have the same size; the pictures have one channel.
struct FlickerFrame {
  scene::Camera camera;
  std::vector<Hit> hits;  // castPrimary() of all pixels
  image::Image ao;        // the effect's picture
  image::Image truth;
};

struct Flicker {
  double rms = 0;       // 0 if there are no points
  uint64_t points = 0;  // number of pixel pairs in `rms`
  double error = 0;     // rms of ao - truth where both are finite, in all frames except the first
};

// Each pixel p that sees a surface, in each frame except the last, is reprojected into the next
// frame: the world point at its centre falls into a pixel q. The point is visible there if it is
// beyond the near plane, inside the picture, and close to q's surface: its view depth differs from
// that of the plane of the facet at q's centre, at the same place of the picture, by at most
// `tolerance` times its own. Over all visible points where the four values are finite,
//
//   rms = sqrt(mean(((ao'(q) - ao(p)) - (truth'(q) - truth(p)))^2)),
//
// with equal weights for all points of all pairs of frames. The rms is 0 for ao = truth on any
// path, and 2 a for ao that alternates between a above and a below the truth. Reads the nearest
// pixel, because interpolation would smooth the noise to be measured. Throws kImageMismatch if the
// pictures have different sizes or not exactly one channel.
Flicker flicker(std::span<const FlickerFrame> frames, double tolerance = 0.01);

// Returns the differences that flicker() averages, from one frame to the next, for each pixel of
// `now`: one channel, NaN where the point is not visible in `then` or a value is not finite. Throws
// the errors of flicker().
image::Image changeBetween(const FlickerFrame& now, const FlickerFrame& then,
                           double tolerance = 0.01);

}  // namespace grisaille::trace
