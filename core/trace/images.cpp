// SPDX-License-Identifier: MIT
#include "core/trace/ray_tracer.h"

namespace grisaille::trace {
namespace {

image::Image emptyImage(uint32_t width, uint32_t height, uint32_t channels) {
  image::Image image{.width = width, .height = height, .channels = channels, .pixels = {}};
  image.pixels.reserve(size_t{width} * height * channels);
  return image;
}

}  // namespace

image::Image depthImage(std::span<const Hit> hits, uint32_t width, uint32_t height) {
  image::Image image = emptyImage(width, height, 1);
  for (const Hit& hit : hits) image.pixels.push_back(static_cast<float>(hit.viewDepth));
  return image;
}

image::Image normalImage(std::span<const Hit> hits, uint32_t width, uint32_t height) {
  image::Image image = emptyImage(width, height, 3);
  for (const Hit& hit : hits) {
    for (int axis = 0; axis < 3; ++axis) image.pixels.push_back(hit.normal[axis]);
  }
  return image;
}

image::Image visibilityImage(std::span<const Visibility> values, uint32_t width, uint32_t height) {
  image::Image image = emptyImage(width, height, 1);
  for (const Visibility& value : values) image.pixels.push_back(value.mean);
  return image;
}

image::Image standardErrorImage(std::span<const Visibility> values, uint32_t width,
                                uint32_t height) {
  image::Image image = emptyImage(width, height, 1);
  for (const Visibility& value : values) image.pixels.push_back(value.standardError);
  return image;
}

}  // namespace grisaille::trace
