// SPDX-License-Identifier: MIT
// What of pictures is OpenImageIO's work. It lies in a library of its own, which is loaded when the
// first picture goes into or out of a file: OpenImageIO brings some 260 libraries along, and a
// program that needs none of them would spend nearly all of its start on loading them.
#pragma once

#include "core/image/image.h"

namespace grisaille::image {

// As the functions of image.h. What goes in was checked.
struct Codecs {
  std::vector<unsigned char> (*exrOf)(const Image& image, const WriteOptions& options);
  std::vector<unsigned char> (*pngOf)(const Image& image, const WriteOptions& options);
  Image (*read)(const std::string& path);
  Picture (*readPicture)(const std::string& path);
  Image8 (*decode)(std::span<const std::byte> encoded, const std::string& name);
  std::vector<std::byte> (*encodePng)(const Image8& image);
  std::vector<std::byte> (*encodeJpeg)(const Image& image, int quality);
};

// What the library exports.
using CodecsOf = const Codecs*();
constexpr const char* kCodecsFunction = "grisaille_codecs";

}  // namespace grisaille::image
