// SPDX-License-Identifier: MIT
// Prints the tables of effects: as text for people, as JSON for programs, as Markdown for manuals.
#pragma once

#include <string>

#include "core/effect/registry.h"

namespace grisaille::app {

std::string effectsText(const effect::Registry& registry);
std::string effectsJson(const effect::Registry& registry);

// Markdown tables of one effect: parameters, outputs, and fields of objects and presets if the
// effect has them. Throws as loadPresets() does.
std::string effectMarkdown(const effect::Effect& effect);

}  // namespace grisaille::app
