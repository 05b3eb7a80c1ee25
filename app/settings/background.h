// SPDX-License-Identifier: MIT
// The background of the composed picture as text, as on the command line and in settings files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/frame/renderer.h"

namespace grisaille::app {

// None unless the text is "transparent" or a colour, #rrggbb.
std::optional<frame::Background> backgroundOf(std::string_view text);

std::string textOf(const frame::Background& background);

}  // namespace grisaille::app
