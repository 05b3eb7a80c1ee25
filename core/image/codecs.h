// SPDX-License-Identifier: MIT
// The image functions that use OpenImageIO. They are in a separate library, which is loaded when
// the program first reads a picture, except for PNGs of scenes and effects (decode_png.h).
// OpenImageIO depends on some 260 libraries; loading them takes 0.25 CPU seconds.
#pragma once

#include "core/image/image.h"

namespace grisaille::image {

constexpr int kLargestSide = 16384;  // of a picture that is read, pixels

// See the functions of image.h. The caller has checked the arguments.
struct Codecs {
  Image (*read)(const std::string& path);
  Picture (*readPicture)(const std::string& path);
  // Not PNGs.
  Image8 (*decode)(std::span<const std::byte> encoded, const std::string& name);
  Alpha8 (*decodeAlpha)(std::span<const std::byte> encoded, const std::string& name);
  // pixels: width * height * channels, 1 or 3 channels
  std::vector<std::byte> (*encodeJpeg)(const std::vector<uint8_t>& pixels, uint32_t width,
                                       uint32_t height, uint32_t channels, int quality);
};

// The function that the library exports, and its name.
using CodecsOf = const Codecs*();
constexpr const char* kCodecsFunction = "grisaille_codecs";

}  // namespace grisaille::image
