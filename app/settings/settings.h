// SPDX-License-Identifier: MIT
// Settings files, in TOML: `effects`, an array of keys in the order they run; `surface`, "white" or
// "base" (base colours); `background`, "#rrggbb" or "transparent"; and a table of parameter values
// for each effect:
//
//   effects = ["ssao"]
//   surface = "white"
//   background = "#808080"
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
    std::string place;  // "file:line", for messages; "": not from a file
  };
  std::optional<std::vector<std::string>> effects;
  std::optional<std::string> surface;          // "white" or "base"
  std::optional<std::string> background = {};  // as backgroundOf() reads it
  std::vector<Value> values;
};

// The keys beside the tables of the effects, which no effect may have.
constexpr const char* kReservedKeys[] = {"effects", "surface", "background"};

// Reads a settings file. Throws kSettingsUnreadable, kSettingsInvalid with the line.
Settings readSettings(const std::string& path);

// The text of a settings file. It reads back to the same effects, surface, background and value
// texts, character by character. If a parameter has several values, the last one is written. The
// tables are in the order of the values. Throws kSettingsInvalid for an effect whose key is one of
// kReservedKeys.
std::string settingsToml(const Settings& settings);

// Writes a settings file atomically. Throws kFileUnwritable, and as settingsToml() does.
void writeSettings(const Settings& settings, const std::string& path);

// Sets the values. Throws as Selection::set() does, with the value's place in the message.
void applySettings(const Settings& settings, effect::Selection& selection);

// The effects that are on, in order, with all their values except the lengths that follow the
// scene.
Settings settingsOf(const effect::Selection& selection);

}  // namespace grisaille::app
