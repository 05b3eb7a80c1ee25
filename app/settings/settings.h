// SPDX-License-Identifier: MIT
// Settings files: TOML with `effects`, an array of keys in the order they run, `surface`, what the
// light falls on, and a table of parameter values for each effect:
//
//   effects = ["ssao"]
//   surface = "white"
//   [ssao]
//   radius = 0.5
//   range_check = "linear"
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/effect/selection.h"

namespace grisaille::app {

struct Settings {
  struct Value {
    effect::ParameterName name;
    std::string text;   // as on the command line
    std::string place;  // "file:line", for messages; "": of no file
  };
  std::optional<std::vector<std::string>> effects;
  std::optional<std::string> surface;  // "white" or "base"
  std::vector<Value> values;
};

// Throws kSettingsUnreadable, kSettingsInvalid with the line.
Settings readSettings(const std::string& path);

// A file that reads back to the same effects, surface and texts, to the last character; of an
// effect's values of one key the last one. The tables are in the order of the values. Throws
// kSettingsInvalid for an effect whose key is `effects` or `surface`.
std::string settingsToml(const Settings& settings);

// Writes the file aside and renames it. Throws kFileUnwritable, and as settingsToml() does.
void writeSettings(const Settings& settings, const std::string& path);

// Sets the values. Throws as Selection::set() does, with the place.
void applySettings(const Settings& settings, effect::Selection& selection);

// The effects that are on, in order, with all their values.
Settings settingsOf(const effect::Selection& selection);

}  // namespace grisaille::app
