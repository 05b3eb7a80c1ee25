// SPDX-License-Identifier: MIT
// How much an effect's picture changes along a camera path where the truth does not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::trace {

// One frame of the path. All frames are of one size; the pictures have one channel.
struct FlickerFrame {
  scene::Camera camera;
  std::vector<Hit> hits;  // castPrimary() of all pixels
  image::Image ao;        // what is measured
  image::Image truth;
};

struct Flicker {
  double rms = 0;       // 0: no points
  uint64_t points = 0;  // pairs of pixels that the rms is over
  double error = 0;     // rms of ao - truth where both are finite, over all frames but the first
};

// For each frame but the last and each pixel p of it that sees a surface: the world point at its
// centre falls into a pixel q of the next frame. The point is visible there when it is in front of
// the near plane, inside the picture, and its view depth differs from that of q's surface at the
// same place of the picture (the plane of the facet at q's centre) by `tolerance` times its own at
// most. Over all visible points where the four values are finite,
//
//   rms = sqrt(mean(((ao'(q) - ao(p)) - (truth'(q) - truth(p)))^2)),
//
// each point of each pair of frames weighing the same. It is 0 for ao = truth, whatever the path,
// and 2 a for ao that is in turn a over and a under the truth. The nearest pixel is read, since
// interpolation would smooth the noise that is to be measured. Throws kImageMismatch for pictures
// that are not of one size or have other than one channel.
Flicker flicker(std::span<const FlickerFrame> frames, double tolerance = 0.01);

// What flicker() takes the mean square of, from one frame to the next: one channel, at each pixel
// of `now`; NaN where its point is not visible in `then` or a value is not finite. Throws as it
// does.
image::Image changeBetween(const FlickerFrame& now, const FlickerFrame& then,
                           double tolerance = 0.01);

}  // namespace grisaille::trace
