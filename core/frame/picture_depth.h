// SPDX-License-Identifier: MIT
// The meaning of the numbers in a depth picture.
#pragma once

#include <limits>
#include <string>

#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::frame {

enum class DepthKind : uint8_t {
  kView,          // metres along the view direction; 0, or 1e9 and more: sky
  kClipReversed,  // a depth buffer with 1 at the near plane, 0 at the far plane and in the sky
  kClip,          // a depth buffer with 0 at the near plane, 1 at the far plane and in the sky
  // Metres from the eye, or for an orthographic camera along the view direction; 0, or 1e9 and
  // more: sky.
  kDistance
};

struct DepthMeaning {
  DepthKind kind = DepthKind::kView;
  double near = 0.01;  // near plane of a depth buffer, metres
  // Metres; may be infinite, except for the depth buffer of an orthographic camera. The far plane
  // of a depth buffer; for depths in metres, the least depth that counts as sky.
  double far = std::numeric_limits<double>::infinity();
};

// Converts a picture of one channel to view depth in metres, 0 in the sky. Throws kPictureDepth
// with the pixel if a value is NaN, negative or, in a depth buffer, over 1. `name` is for messages.
image::Image viewDepthOf(const image::Image& depth, const DepthMeaning& meaning,
                         const scene::Camera& camera, const std::string& name);

}  // namespace grisaille::frame
