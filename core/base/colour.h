// SPDX-License-Identifier: MIT
// Colours as text: #rrggbb, sRGB encoded.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace grisaille {

// Red, green and blue, linear light, 0 to 1.
using LinearColour = std::array<float, 3>;

// None unless the text has the form #rrggbb.
std::optional<LinearColour> colourOf(std::string_view text);

// The nearest colour of the form #rrggbb.
std::string colourText(const LinearColour& colour);

}  // namespace grisaille
