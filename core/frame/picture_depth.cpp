// SPDX-License-Identifier: MIT
#include "core/frame/picture_depth.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/view.h"

namespace grisaille::frame {
namespace {

// Renderers write 1e10 or more for the sky. Depths of a scene are smaller.
constexpr double kSky = 1e9;  // metres

// View depth in metres of a depth buffer's value that is 1 at the near plane.
double viewDepth(double reversed, const DepthMeaning& meaning, bool orthographic) {
  const double near = meaning.near, far = meaning.far;
  if (reversed <= 0) return 0;
  if (orthographic) return far - reversed * (far - near);
  if (std::isinf(far)) return near / reversed;
  return near * far / (near + reversed * (far - near));
}

double metres(double value, const DepthMeaning& meaning, double ray, bool orthographic) {
  switch (meaning.kind) {
    case DepthKind::kView:
      return value >= std::min(meaning.far, kSky) ? 0 : value;
    case DepthKind::kDistance:
      return value >= std::min(meaning.far, kSky) ? 0 : value / ray;
    case DepthKind::kClipReversed:
      return viewDepth(value, meaning, orthographic);
    case DepthKind::kClip:
      return viewDepth(1 - value, meaning, orthographic);
  }
  return 0;
}

}  // namespace

image::Image viewDepthOf(const image::Image& depth, const DepthMeaning& meaning,
                         const scene::Camera& camera, const std::string& name) {
  const bool buffer = meaning.kind == DepthKind::kClip || meaning.kind == DepthKind::kClipReversed;
  const double most = buffer ? 1 : std::numeric_limits<double>::infinity();
  const scene::View view = scene::viewOf(camera, {depth.width, depth.height});
  image::Image result = depth;
  for (uint32_t y = 0; y < depth.height; ++y) {
    for (uint32_t x = 0; x < depth.width; ++x) {
      float& pixel = result.pixels[size_t{y} * depth.width + x];
      const double value{pixel};
      if (!(value >= 0 && value <= most)) {
        throw Error(ErrorId::kPictureDepth, "{}: the depth at ({}, {}) is {}", name, x, y, value);
      }
      const glm::dvec3 direction = scene::rayAt(view, glm::dvec2(x, y) + 0.5).direction;
      pixel = static_cast<float>(metres(value, meaning, glm::length(direction), view.orthographic));
    }
  }
  return result;
}

}  // namespace grisaille::frame
