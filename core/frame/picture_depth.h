// SPDX-License-Identifier: MIT
// What the numbers of a depth picture mean.
#pragma once

#include <limits>
#include <string>

#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::frame {

enum class DepthKind : uint8_t {
  kView,          // metres along the view direction; 0, or 1e9 and more: sky
  kClipReversed,  // a depth buffer with 1 at the near plane and 0 at the far one and in the sky
  kClip,          // a depth buffer with 0 at the near plane and 1 at the far one and in the sky
  kDistance       // metres from the eye; 0, or 1e9 and more: sky
};

struct DepthMeaning {
  DepthKind kind = DepthKind::kView;
  double near = 0.01;  // metres; of depth buffers
  // Metres; may be infinite. Of depth buffers the far plane; of metres what is as far is sky.
  double far = std::numeric_limits<double>::infinity();
};

// View depth in metres, 0 in the sky, of a picture of one channel. Throws kPictureDepth with the
// pixel for what is no number, negative or, of a depth buffer, over 1; `name` is for messages.
image::Image viewDepthOf(const image::Image& depth, const DepthMeaning& meaning,
                         const scene::Camera& camera, const std::string& name);

}  // namespace grisaille::frame
