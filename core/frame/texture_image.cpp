// SPDX-License-Identifier: MIT
#include "core/frame/texture_image.h"

#include <cstring>
#include <glm/gtc/color_space.hpp>
#include <glm/gtc/packing.hpp>

namespace grisaille::frame {
namespace {

template <typename Number, typename Convert>
void convert(std::span<const std::byte> bytes, std::vector<float>& to, Convert&& number) {
  for (size_t i = 0; i < to.size(); ++i) {
    Number value;
    std::memcpy(&value, bytes.data() + i * sizeof(Number), sizeof(Number));
    to[i] = number(value);
  }
}

void linearise(image::Image& image) {
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    const glm::vec3 colour(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
    const glm::vec3 linear = glm::convertSRGBToLinear(colour);
    std::memcpy(&image.pixels[i], &linear, sizeof(linear));
  }
}

}  // namespace

image::Image toImage(std::span<const std::byte> bytes, gpu::Format format, uint32_t width,
                     uint32_t height) {
  image::Image image{
      .width = width, .height = height, .channels = gpu::formatInfo(format).channels, .pixels = {}};
  image.pixels.resize(size_t{width} * height * image.channels);
  switch (format) {
    case gpu::Format::kNone:
      break;
    case gpu::Format::kR8Unorm:
    case gpu::Format::kRgba8Unorm:
    case gpu::Format::kRgba8Srgb:
      convert<uint8_t>(bytes, image.pixels,
                       [](uint8_t v) { return static_cast<float>(v) / 255.0f; });
      break;
    case gpu::Format::kR16Float:
    case gpu::Format::kRgba16Float:
      convert<uint16_t>(bytes, image.pixels, [](uint16_t v) { return glm::unpackHalf1x16(v); });
      break;
    case gpu::Format::kR32Float:
    case gpu::Format::kRg32Float:
    case gpu::Format::kRgba32Float:
    case gpu::Format::kD32Float:
      convert<float>(bytes, image.pixels, [](float v) { return v; });
      break;
    case gpu::Format::kR32Uint:
      convert<uint32_t>(bytes, image.pixels, [](uint32_t v) { return static_cast<float>(v); });
      break;
  }
  if (format == gpu::Format::kRgba8Srgb) linearise(image);
  return image;
}

image::Image firstChannels(const image::Image& image, uint32_t channels) {
  image::Image first{
      .width = image.width, .height = image.height, .channels = channels, .pixels = {}};
  first.pixels.reserve(size_t{image.width} * image.height * channels);
  for (size_t i = 0; i < image.pixels.size(); i += image.channels) {
    first.pixels.insert(first.pixels.end(), image.pixels.begin() + static_cast<ptrdiff_t>(i),
                        image.pixels.begin() + static_cast<ptrdiff_t>(i + channels));
  }
  return first;
}

}  // namespace grisaille::frame
