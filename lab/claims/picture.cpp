// SPDX-License-Identifier: MIT
#include "lab/claims/picture.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/color_space.hpp>

#include "app/truth/error_map.h"

namespace grisaille::lab::claims {
namespace {

const glm::vec3 kSky(0.8f, 0.9f, 1.0f);  // sRGB

// The colour of a pixel, sRGB, 0 to 1.
glm::vec3 colorAt(const image::Image& picture, uint32_t x, uint32_t y, const PictureDesc& desc) {
  if (picture.channels >= 3) {
    const glm::vec3 linear(picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2));
    return glm::convertLinearToSRGB(glm::clamp(linear, 0.0f, 1.0f));
  }
  const double value = picture.at(x, y);
  if (std::isnan(value)) return kSky;
  const double share = (value - desc.low) / (desc.high - desc.low);
  return glm::vec3(static_cast<float>(std::clamp(share, 0.0, 1.0)));
}

}  // namespace

image::Image8 pictureOf(const image::Image& picture, const PictureDesc& desc) {
  const glm::uvec4& crop = desc.crop;
  image::Image8 result{.width = crop.z * desc.zoom, .height = crop.w * desc.zoom, .pixels = {}};
  result.pixels.reserve(size_t{result.width} * result.height * 4);
  for (uint32_t y = 0; y < result.height; ++y) {
    for (uint32_t x = 0; x < result.width; ++x) {
      const glm::vec3 color =
          colorAt(picture, crop.x + x / desc.zoom, crop.y + y / desc.zoom, desc);
      for (int c = 0; c < 3; ++c) {
        result.pixels.push_back(static_cast<uint8_t>(std::lround(color[c] * 255)));
      }
      result.pixels.push_back(255);
    }
  }
  return result;
}

image::Image8 changePicture(const trace::FlickerFrame& now, const trace::FlickerFrame& then,
                            const PictureDesc& desc) {
  image::Image map =
      app::truth::errorMap(trace::changeBetween(now, then), static_cast<float>(desc.high));
  // The map's colours are sRGB encoded; pictureOf() takes linear colours.
  for (float& value : map.pixels) value = glm::convertSRGBToLinear(glm::vec1(value)).x;
  return pictureOf(map, desc);
}

}  // namespace grisaille::lab::claims
