// SPDX-License-Identifier: MIT
// The image functions that use OpenImageIO. They are in a separate library, which is loaded when
// the program first reads or writes a picture file. OpenImageIO depends on some 260 libraries;
// loading them would take nearly all of the start-up time of a program that needs none of them.
#pragma once

#include "core/image/image.h"

namespace grisaille::image {

// See the functions of image.h. The caller has checked the arguments.
struct Codecs {
  std::vector<unsigned char> (*exrOf)(const Image& image, const WriteOptions& options);
  std::vector<unsigned char> (*pngOf)(const Image& image, const WriteOptions& options);
  Image (*read)(const std::string& path);
  Picture (*readPicture)(const std::string& path);
  Image8 (*decode)(std::span<const std::byte> encoded, const std::string& name);
  Alpha8 (*decodeAlpha)(std::span<const std::byte> encoded, const std::string& name);
  std::vector<std::byte> (*encodePng)(const Image8& image);
  std::vector<std::byte> (*encodeJpeg)(const Image& image, int quality);
};

// The function that the library exports, and its name.
using CodecsOf = const Codecs*();
constexpr const char* kCodecsFunction = "grisaille_codecs";

}  // namespace grisaille::image
