// SPDX-License-Identifier: MIT
// Decodes PNGs in memory with libpng: the format of most alpha masks. See codecs.h for why
// OpenImageIO is not used.
#pragma once

#include "core/image/image.h"

namespace grisaille::image {

bool isPng(std::span<const std::byte> encoded);

// See decode() and decodeAlpha(). Throw kSceneImage.
Image8 decodePng(std::span<const std::byte> encoded, const std::string& name);
Alpha8 decodePngAlpha(std::span<const std::byte> encoded, const std::string& name);

}  // namespace grisaille::image
