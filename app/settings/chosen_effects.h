// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/settings/settings.h"

namespace grisaille::app {

// These effects, on, in this order, with the values of presets ("EFFECT=NAME") beneath those of the
// settings. Throws kEffectUnknown, kEffectTwice, and as applyPresets() and applySettings() do.
effect::Selection chosenEffects(const effect::Registry& registry,
                                const std::vector<std::string>& keys,
                                const std::vector<std::string>& presets, const Settings& settings);

}  // namespace grisaille::app
