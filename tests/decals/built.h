// SPDX-License-Identifier: MIT
// The example, built.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/image/image.h"
#include "tests/program/run.h"

namespace grisaille::tests {

// The folder of the plugin. Its project was copied to a folder of its own and built there against
// an installation, by the first call. Throws std::runtime_error where that fails.
const std::string& builtDecals();
// The installation that it was built against.
std::string installedPrefix();

using Colour = std::array<uint8_t, 4>;  // sRGB, straight alpha
inline constexpr Colour kRed{200, 40, 30, 255}, kGreen{30, 160, 60, 255}, kBlue{20, 60, 220, 255},
    kGrey{128, 128, 128, 255};

// 64 x 64 pixels in four squares: top left, top right, bottom left, bottom right.
image::Image8 squares(const std::array<Colour, 4>& colours);
void writePng(const image::Image8& picture, const TemporaryFolder& folder, const std::string& name);

// Of one channel, 0 to 1.
float linear(uint8_t srgb);

}  // namespace grisaille::tests

// What the sanitizers watch is not installed.
#define GRISAILLE_NEEDS_INSTALLATION() \
  if (SANITIZED) GTEST_SKIP() << "what the sanitizers watch is not installed"
