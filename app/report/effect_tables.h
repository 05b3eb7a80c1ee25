// SPDX-License-Identifier: MIT
// The effects' own tables as text: for people, for programs, for the manual.
#pragma once

#include <string>

#include "core/effect/registry.h"

namespace grisaille::app {

std::string effectsText(const effect::Registry& registry);
std::string effectsJson(const effect::Registry& registry);

// One effect's parameters and outputs as two Markdown tables.
std::string effectMarkdown(const effect::Effect& effect);

}  // namespace grisaille::app
