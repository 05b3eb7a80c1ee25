// SPDX-License-Identifier: MIT
// Converts parameter values between text and TOML.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace grisaille::app {

// The text of a number, boolean or string, for effect::Values::set(). Throws kSettingsInvalid with
// `place` for any other node. `key`: for the message.
std::string tomlNodeText(const toml::node& node, std::string_view key, const std::string& place);

// Parses a file. Throws kSettingsUnreadable, with the line where possible, if the file cannot be
// read, is larger than 1 MiB, has a key of too many parts or is not TOML.
toml::table parseTomlFile(const std::string& path);

// The text as TOML: a number or a boolean if it reads back to the same text, else a string.
std::string tomlValue(const std::string& text);

// The text as a TOML string.
std::string tomlText(const std::string& text);

}  // namespace grisaille::app
