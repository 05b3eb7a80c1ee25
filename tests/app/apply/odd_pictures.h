// SPDX-License-Identifier: MIT
// EXR files that core/image does not write.
#pragma once

#include <string>

#include "core/image/image.h"

namespace grisaille::tests {

// Writes 4 x 2 pixels with 0 to 2 depths each, in the channel Z. Throws std::runtime_error.
void writeDeepPicture(const std::string& path);

// Writes a picture whose header says that its pixels have this aspect ratio. Throws
// std::runtime_error.
void writeWithAspect(const image::Image& image, float aspect, const std::string& path);

}  // namespace grisaille::tests
