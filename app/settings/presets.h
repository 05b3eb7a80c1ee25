// SPDX-License-Identifier: MIT
// Presets of an effect, each with its error and cost. A study writes them to KEY.presets.toml
// beside the plugin.
//
//   study = "where the numbers come from, in a sentence"
//   [fast]
//   error = 0.105           # RMSE against the truth
//   cost = 0.31             # balanced = 1
//   values = {kernel_size = 8, blur_size = 4}
//
// The four presets of kPresetNames must be there; others may follow.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/effect/selection.h"

namespace grisaille::app {

inline constexpr const char* kPresetNames[] = {"fast", "balanced", "fine", "reference"};

struct Preset {
  std::string name;  // see isPresetName()
  double error = 0;
  double cost = 0;  // as a multiple of the cost of `balanced`
  // Key and value as text. Parameters that are not listed have their defaults.
  std::vector<std::pair<std::string, std::string>> values;
};

struct Presets {
  std::string study;
  std::vector<Preset> all;  // first those of kPresetNames, in that order

  // Throws kPresetUnknown.
  const Preset& find(const std::string& effect, const std::string& name) const;
};

// Whether a preset may have this name: a-z, 0-9, _, beginning with a letter; not "study".
bool isPresetName(std::string_view name);

std::filesystem::path presetsFile(const effect::Effect& effect);

// Reads the presets file; no presets if it does not exist. Throws kPresetFile if the file is
// damaged or a value does not fit the effect's table.
Presets loadPresets(const effect::Effect& effect);

// The text of a file that loadPresets() reads.
std::string presetsToml(const Presets& presets);

// Sets the values of the preset, and the defaults of parameters that only other presets name. A
// parameter of look (GRISAILLE_PARAM_LOOK) keeps its value, unless one of those presets gave it
// that value. Throws kPresetUnknown.
void applyPreset(effect::Values& values, const Presets& presets, const std::string& name);

// The parameters that a search may change: those that a preset names, and all that are not
// advanced; none of look (GRISAILLE_PARAM_LOOK).
std::vector<const grisaille_param_desc*> tunable(const effect::Effect& effect,
                                                 const Presets& presets);

// The first preset that matches the values; null: none does, or a parameter that no preset names
// has another value than its default, with which errors and costs were measured (those of look may
// have any).
const Preset* presetOf(const effect::Values& values, const Presets& presets);

// "error 0.106, cost 0.54 x balanced"
std::string priceOf(const Preset& preset);

// Applies "EFFECT=NAME" assignments in order. Throws kUsage, kEffectUnknown if the effect is not
// active, kPresetUnknown, kPresetFile.
void applyPresets(const std::vector<std::string>& assignments, effect::Selection& selection);

}  // namespace grisaille::app
