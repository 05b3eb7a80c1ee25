// SPDX-License-Identifier: MIT
// A deep EXR: any number of samples per pixel.
#pragma once

#include <string>

namespace grisaille::tests {

// Writes 4 x 2 pixels with 0 to 2 depths each, in the channel Z. Throws std::runtime_error.
void writeDeepPicture(const std::string& path);

}  // namespace grisaille::tests
