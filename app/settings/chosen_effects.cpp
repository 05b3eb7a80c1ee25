// SPDX-License-Identifier: MIT
#include "app/settings/chosen_effects.h"

#include "app/settings/presets.h"

namespace grisaille::app {

effect::Selection chosenEffects(const effect::Registry& registry,
                                const std::vector<std::string>& keys,
                                const std::vector<std::string>& presets, const Settings& settings) {
  effect::Selection selection(registry, keys);
  applyPresets(presets, selection);
  applySettings(settings, selection);
  return selection;
}

}  // namespace grisaille::app
