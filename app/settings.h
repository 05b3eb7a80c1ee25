// SPDX-License-Identifier: MIT
// Settings files: TOML with `effects`, an array of keys in the order they run, and a table of
// parameter values for each effect:
//
//   effects = ["ssao"]
//   [ssao]
//   radius = 0.5
//   range_check = "linear"
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace grisaille::app {

struct Settings {
  struct Value {
    std::string effect, key;
    std::string text;   // as on the command line
    std::string place;  // "file:line", for messages
  };
  std::optional<std::vector<std::string>> effects;
  std::vector<Value> values;
};

// Throws kSettingsUnreadable, kSettingsInvalid with the line.
Settings readSettings(const std::string& path);

}  // namespace grisaille::app
