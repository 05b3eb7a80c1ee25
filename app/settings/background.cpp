// SPDX-License-Identifier: MIT
#include "app/settings/background.h"

#include "core/base/colour.h"

namespace grisaille::app {
namespace {

constexpr std::string_view kNone = "transparent";

}  // namespace

std::optional<frame::Background> backgroundOf(std::string_view text) {
  if (text == kNone) return frame::kTransparent;
  const auto colour = colourOf(text);
  if (!colour) return std::nullopt;
  return frame::Background((*colour)[0], (*colour)[1], (*colour)[2], 1);
}

std::string textOf(const frame::Background& background) {
  if (background.a == 0) return std::string(kNone);
  return colourText({background.r, background.g, background.b});
}

}  // namespace grisaille::app
