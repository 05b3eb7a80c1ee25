// SPDX-License-Identifier: MIT
#include "app/settings/presets.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "app/settings/toml_values.h"
#include "core/base/error.h"
#include "core/effect/parameter_name.h"

namespace grisaille::app {
namespace {

double numberOf(const toml::table& table, const char* key, const std::string& place) {
  const auto value = table[key].value<double>();
  if (!value || !(*value >= 0)) {
    throw Error(ErrorId::kPresetFile, "{}: '{}' must be a number of 0 or more", place, key);
  }
  return *value;
}

Preset presetFrom(const effect::Effect& effect, const std::string& name, const toml::table& table,
                  const std::string& place) {
  Preset preset{.name = name,
                .error = numberOf(table, "error", place),
                .cost = numberOf(table, "cost", place),
                .values = {}};
  const toml::table* values = table["values"].as_table();
  if (values == nullptr)
    throw Error(ErrorId::kPresetFile, "{}: the table 'values' is missing", place);
  effect::Values checked(effect);
  for (const auto& [key, node] : *values) {
    try {
      checked.set(key.str(), tomlNodeText(node, key.str(), place));
    } catch (const Error& error) {
      throw Error(ErrorId::kPresetFile, "{}: {}", place, error.detail());
    }
    preset.values.emplace_back(key.str(), checked.text(key.str()));
  }
  return preset;
}

// The keys of all parameters that a preset names.
std::set<std::string, std::less<>> namedIn(const Presets& presets) {
  std::set<std::string, std::less<>> named;
  for (const Preset& preset : presets.all) {
    for (const auto& [key, text] : preset.values) named.insert(key);
  }
  return named;
}

}  // namespace

const Preset& Presets::find(const std::string& effect, const std::string& name) const {
  const auto found = std::ranges::find(all, name, &Preset::name);
  if (found != all.end()) return *found;
  if (all.empty()) throw Error(ErrorId::kPresetUnknown, "effect '{}' has no presets", effect);
  std::vector<std::string> names;
  for (const Preset& preset : all) names.push_back(preset.name);
  throw Error(ErrorId::kPresetUnknown, "effect '{}' has no preset '{}', only {}", effect, name,
              fmt::join(names, ", "));
}

bool isPresetName(std::string_view name) {
  return effect::isKey(name) && name != "study";
}

std::filesystem::path presetsFile(const effect::Effect& effect) {
  return std::filesystem::path(effect.path).parent_path() /
         (std::string(effect.desc->key) + ".presets.toml");
}

Presets loadPresets(const effect::Effect& effect) {
  Presets presets;
  const std::string path = presetsFile(effect);
  if (!std::filesystem::exists(path)) return presets;
  toml::table table;
  try {
    table = parseTomlFile(path);
  } catch (const Error& error) {
    throw Error(ErrorId::kPresetFile, "{}", error.detail());
  }
  presets.study = table["study"].value_or(std::string());
  std::vector<std::string> names(std::begin(kPresetNames), std::end(kPresetNames));
  for (const auto& [key, node] : table) {
    if (key == "study" || std::ranges::count(names, key.str()) > 0) continue;
    if (!isPresetName(key.str())) {
      throw Error(ErrorId::kPresetFile, "{}: '{}' is no name of a preset: use a-z, 0-9, _", path,
                  oneLine(key.str()));
    }
    names.emplace_back(key.str());
  }
  for (const std::string& name : names) {
    const toml::table* own = table[name].as_table();
    if (own == nullptr)
      throw Error(ErrorId::kPresetFile, "{}: the table '{}' is missing", path, name);
    presets.all.push_back(
        presetFrom(effect, name, *own, fmt::format("{}:{}", path, own->source().begin.line)));
  }
  return presets;
}

std::string presetsToml(const Presets& presets) {
  std::string text = fmt::format("study = {}\n", tomlText(presets.study));
  for (const Preset& preset : presets.all) {
    std::string values;
    for (const auto& [key, value] : preset.values) {
      values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", key, tomlValue(value));
    }
    text += fmt::format("\n[{}]\nerror = {:.5f}\ncost = {:.4f}\nvalues = {{{}}}\n", preset.name,
                        preset.error, preset.cost, values);
  }
  return text;
}

void applyPreset(effect::Values& values, const Presets& presets, const std::string& name) {
  const Preset& chosen = presets.find(values.effect().desc->key, name);
  for (const Preset& preset : presets.all) {
    for (const auto& [key, text] : preset.values) {
      const uint32_t flags = values.effect().params()[values.indexOf(key)].flags;
      const bool look = (flags & GRISAILLE_PARAM_LOOK) != 0;
      if (!look || values.text(key) == text) values.reset(key);
    }
  }
  for (const auto& [key, text] : chosen.values) values.set(key, text);
}

std::vector<const grisaille_param_desc*> tunable(const effect::Effect& effect,
                                                 const Presets& presets) {
  const std::set<std::string, std::less<>> named = namedIn(presets);
  std::vector<const grisaille_param_desc*> params;
  for (const grisaille_param_desc& param : effect.params()) {
    const bool folded = (param.flags & GRISAILLE_PARAM_ADVANCED) != 0;
    const bool look = (param.flags & GRISAILLE_PARAM_LOOK) != 0;
    if (!look && (!folded || named.contains(param.key))) params.push_back(&param);
  }
  return params;
}

const Preset* presetOf(const effect::Values& values, const Presets& presets) {
  const std::set<std::string, std::less<>> named = namedIn(presets);
  for (const grisaille_param_desc& param : values.effect().params()) {
    const bool free = named.contains(param.key) || (param.flags & GRISAILLE_PARAM_LOOK) != 0;
    if (!free && values.get(param.key) != values.defaultOf(param.key)) return nullptr;
  }
  for (const Preset& preset : presets.all) {
    effect::Values applied = values;
    applyPreset(applied, presets, preset.name);
    if (std::ranges::equal(applied.all(), values.all())) return &preset;
  }
  return nullptr;
}

std::string priceOf(const Preset& preset) {
  return fmt::format("error {:.3f}, cost {:.2f} x balanced", preset.error, preset.cost);
}

void applyPresets(const std::vector<std::string>& assignments, effect::Selection& selection) {
  for (const std::string& text : assignments) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos) {
      throw Error(ErrorId::kUsage, "--preset '{}' is not of the form EFFECT=NAME", text);
    }
    effect::Values& values = selection.values(text.substr(0, equals));
    applyPreset(values, loadPresets(values.effect()), text.substr(equals + 1));
  }
}

}  // namespace grisaille::app
