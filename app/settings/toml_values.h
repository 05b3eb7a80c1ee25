// SPDX-License-Identifier: MIT
// Values of parameters in TOML files, as text on the one side and TOML on the other.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace grisaille::app {

// A number, boolean or string as effect::Values::set() takes it. Throws kSettingsInvalid with
// `place` for anything else.
std::string tomlNodeText(const toml::node& node, std::string_view key, const std::string& place);

// Parses a file. Throws kSettingsUnreadable where it cannot be read, is too large to be a person's
// or is no TOML, with the line.
toml::table parseTomlFile(const std::string& path);

// The text as TOML: a number or a boolean where that reads back to the same text, else a string.
std::string tomlValue(const std::string& text);

// The text as a TOML string.
std::string tomlText(const std::string& text);

}  // namespace grisaille::app
