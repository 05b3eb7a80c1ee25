// SPDX-License-Identifier: MIT
#include "app/settings/settings.h"

#include <algorithm>

#include "app/settings/background.h"
#include "app/settings/toml_values.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"

namespace grisaille::app {
namespace {

std::string placeOf(const std::string& path, const toml::node& node) {
  return fmt::format("{}:{}", path, node.source().begin.line);
}

std::vector<std::string> effectKeys(const std::string& path, const toml::node& node) {
  const toml::array* array = node.as_array();
  std::vector<std::string> keys;
  for (size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const toml::value<std::string>* key = array->get(i)->as_string();
    if (key == nullptr) {
      array = nullptr;
    } else {
      keys.push_back(key->get());
    }
  }
  if (array == nullptr) {
    throw Error(ErrorId::kSettingsInvalid, "{}: 'effects' must be an array of strings",
                placeOf(path, node));
  }
  return keys;
}

std::string surfaceOf(const std::string& path, const toml::node& node) {
  const toml::value<std::string>* surface = node.as_string();
  if (surface == nullptr || (surface->get() != "white" && surface->get() != "base")) {
    throw Error(ErrorId::kSettingsInvalid, "{}: 'surface' must be \"white\" or \"base\"",
                placeOf(path, node));
  }
  return surface->get();
}

std::string backgroundText(const std::string& path, const toml::node& node) {
  const toml::value<std::string>* background = node.as_string();
  if (background == nullptr || !backgroundOf(background->get())) {
    throw Error(ErrorId::kSettingsInvalid,
                "{}: 'background' must be a colour as in \"#808080\", or \"transparent\"",
                placeOf(path, node));
  }
  return background->get();
}

std::string keyToml(const std::string& key) {
  const auto bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !key.empty() && std::ranges::all_of(key, bare) ? key : tomlText(key);
}

// The table of one effect. If a parameter has several values, the last one counts.
std::string tableToml(const Settings& settings, const std::string& effect) {
  if (std::ranges::find(kReservedKeys, effect) != std::end(kReservedKeys)) {
    throw Error(ErrorId::kSettingsInvalid,
                "effect '{}' has the name of a reserved key of settings files", effect);
  }
  std::vector<const Settings::Value*> values;
  for (const Settings::Value& value : settings.values) {
    if (value.name.effect != effect) continue;
    const auto same = std::ranges::find_if(
        values, [&](const Settings::Value* one) { return one->name.key == value.name.key; });
    if (same == values.end()) {
      values.push_back(&value);
    } else {
      *same = &value;
    }
  }
  std::string text = fmt::format("\n[{}]\n", keyToml(effect));
  for (const Settings::Value* value : values) {
    text += fmt::format("{} = {}\n", keyToml(value->name.key), tomlValue(value->text));
  }
  return text;
}

}  // namespace

Settings readSettings(const std::string& path) {
  const toml::table table = parseTomlFile(path);
  Settings settings;
  for (const auto& [key, node] : table) {
    if (key.str() == "effects") {
      settings.effects = effectKeys(path, node);
    } else if (key.str() == "surface") {
      settings.surface = surfaceOf(path, node);
    } else if (key.str() == "background") {
      settings.background = backgroundText(path, node);
    } else if (const toml::table* values = node.as_table()) {
      for (const auto& [parameter, value] : *values) {
        settings.values.push_back(
            {.name = {.effect = std::string(key.str()), .key = std::string(parameter.str())},
             .text = tomlNodeText(value, parameter.str(), placeOf(path, value)),
             .place = placeOf(path, value)});
      }
    } else {
      throw Error(ErrorId::kSettingsInvalid, "{}: '{}' is neither {} nor the table of an effect",
                  placeOf(path, node), key.str(), fmt::join(kReservedKeys, " nor "));
    }
  }
  return settings;
}

std::string settingsToml(const Settings& settings) {
  std::string text;
  if (settings.effects) {
    std::string keys;
    for (const std::string& key : *settings.effects) {
      keys += (keys.empty() ? "" : ", ") + tomlText(key);
    }
    text += fmt::format("effects = [{}]\n", keys);
  }
  if (settings.surface) text += fmt::format("surface = {}\n", tomlText(*settings.surface));
  if (settings.background) {
    text += fmt::format("background = {}\n", tomlText(*settings.background));
  }
  std::vector<std::string> effects;
  for (const Settings::Value& value : settings.values) {
    const std::string& effect = value.name.effect;
    if (std::ranges::find(effects, effect) == effects.end()) effects.push_back(effect);
  }
  for (const std::string& effect : effects) text += tableToml(settings, effect);
  return text;
}

void writeSettings(const Settings& settings, const std::string& path) {
  writeFileAtomically(path, settingsToml(settings));
}

void applySettings(const Settings& settings, effect::Selection& selection) {
  for (const Settings::Value& value : settings.values) {
    try {
      selection.set({.name = value.name, .value = value.text});
    } catch (const Error& error) {
      if (value.place.empty()) throw;
      throw Error(error.id(), "{}: {}", value.place, error.detail());
    }
  }
}

Settings settingsOf(const effect::Selection& selection) {
  Settings settings;
  settings.effects.emplace();
  for (const effect::Selection::Entry& entry : selection.entries()) {
    if (!entry.on) continue;
    settings.effects->emplace_back(entry.key());
    for (const grisaille_param_desc& param : entry.effect().params()) {
      if (effect::followsScene(entry.values, param)) continue;
      settings.values.push_back({.name = {.effect = entry.key(), .key = param.key},
                                 .text = entry.values.text(param.key),
                                 .place = {}});
    }
  }
  return settings;
}

}  // namespace grisaille::app
