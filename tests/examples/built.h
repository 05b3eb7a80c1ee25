// SPDX-License-Identifier: MIT
// Builds the examples of effects.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/image/image.h"
#include "tests/program/run.h"

namespace grisaille::tests {

// Folder of an example's plugin. The first call copies the example's project to a temporary folder
// and builds it against an installation. Throws std::runtime_error if that fails.
const std::string& builtExample(const std::string& name);
// Prefix of the installation that examples are built against.
const std::string& installedPrefix();

using Colour = std::array<uint8_t, 4>;  // sRGB, straight alpha
inline constexpr Colour kRed{200, 40, 30, 255}, kGreen{30, 160, 60, 255}, kBlue{20, 60, 220, 255},
    kGrey{128, 128, 128, 255};

// A picture of 64 x 64 pixels in four squares: top left, top right, bottom left, bottom right.
image::Image8 squares(const std::array<Colour, 4>& colours);
void writePng(const image::Image8& picture, const TemporaryFolder& folder, const std::string& name);

// sRGB code to linear value, 0 to 1.
float linear(uint8_t srgb);

}  // namespace grisaille::tests

// Builds with sanitizers are not installed.
#define GRISAILLE_NEEDS_INSTALLATION() \
  if (SANITIZED) GTEST_SKIP() << "builds with sanitizers are not installed"
