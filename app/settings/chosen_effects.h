// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/settings/settings.h"

namespace grisaille::app {

// Selects the effects `keys`, all on, in this order. Values of the settings override those of the
// presets ("EFFECT=NAME"). Throws kEffectUnknown, kEffectTwice, and as applyPresets() and
// applySettings() do.
effect::Selection chosenEffects(const effect::Registry& registry,
                                const std::vector<std::string>& keys,
                                const std::vector<std::string>& presets, const Settings& settings);

}  // namespace grisaille::app
