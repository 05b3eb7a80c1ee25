// SPDX-License-Identifier: MIT
// Presets of an effect, each with its price: a file beside the plugin, KEY.presets.toml, that a
// study wrote.
//
//   study = "where the numbers come from, in a sentence"
//   [fast]
//   error = 0.105           # RMSE against the truth
//   cost = 0.31             # balanced = 1
//   values = {kernel_size = 8, blur_size = 4}
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/effect/selection.h"

namespace grisaille::app {

inline constexpr const char* kPresetNames[] = {"fast", "balanced", "fine", "reference"};

struct Preset {
  std::string name;  // of kPresetNames
  double error = 0;
  double cost = 0;  // as a multiple of what `balanced` costs
  std::vector<std::pair<std::string, std::string>> values;  // key and text; others: the defaults
};

struct Presets {
  std::string study;
  std::vector<Preset> all;  // in the order of kPresetNames

  // Throws kPresetUnknown.
  const Preset& find(const std::string& effect, const std::string& name) const;
};

std::filesystem::path presetsFile(const effect::Effect& effect);

// None where there is no such file. Throws kPresetFile, also where a value does not fit the
// effect's table.
Presets loadPresets(const effect::Effect& effect);

// What loadPresets() reads back.
std::string presetsToml(const Presets& presets);

// Sets an effect's values: those of the preset, and the defaults of the parameters that another
// one names. Throws kPresetUnknown.
void applyPreset(effect::Values& values, const Presets& presets, const std::string& name);

// The parameters that a search may change: those that the presets name, and the others that the
// panel does not fold away.
std::vector<const grisaille_param_desc*> tunable(const effect::Effect& effect,
                                                 const Presets& presets);

// The first preset that would change nothing; null: the values are another setting.
const Preset* presetOf(const effect::Values& values, const Presets& presets);

// "error 0.106, cost 0.54 x balanced"
std::string priceOf(const Preset& preset);

// "ssao=balanced", one after the other. Throws kUsage, kEffectUnknown where the effect is not
// active, kPresetUnknown, kPresetFile.
void applyPresets(const std::vector<std::string>& assignments, effect::Selection& selection);

}  // namespace grisaille::app
