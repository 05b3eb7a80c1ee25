// SPDX-License-Identifier: MIT
#include "app/settings.h"

#include <toml++/toml.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace grisaille::app {
namespace {

std::string placeOf(const std::string& path, const toml::node& node) {
  return fmt::format("{}:{}", path, node.source().begin.line);
}

std::string textOf(const std::string& path, std::string_view key, const toml::node& node) {
  if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_floating_point()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  if (const auto* value = node.as_string()) return value->get();
  throw Error(ErrorId::kSettingsInvalid, "{}: '{}' is not a number, a boolean or a string",
              placeOf(path, node), key);
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
    throw Error(ErrorId::kSettingsInvalid, "{}: 'effects' is not an array of strings",
                placeOf(path, node));
  }
  return keys;
}

}  // namespace

Settings readSettings(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw Error(ErrorId::kSettingsUnreadable, "cannot read settings '{}'", path);
  }
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  toml::table table;
  try {
    table = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorId::kSettingsUnreadable, "{}:{}: {}", path, error.source().begin.line,
                error.description());
  }
  Settings settings;
  for (const auto& [key, node] : table) {
    if (key.str() == "effects") {
      settings.effects = effectKeys(path, node);
    } else if (const toml::table* values = node.as_table()) {
      for (const auto& [parameter, value] : *values) {
        settings.values.push_back({.effect = std::string(key.str()),
                                   .key = std::string(parameter.str()),
                                   .text = textOf(path, parameter.str(), value),
                                   .place = placeOf(path, value)});
      }
    } else {
      throw Error(ErrorId::kSettingsInvalid, "{}: '{}' is neither 'effects' nor an effect's table",
                  placeOf(path, node), key.str());
    }
  }
  return settings;
}

}  // namespace grisaille::app
