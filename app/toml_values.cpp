// SPDX-License-Identifier: MIT
#include "app/toml_values.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/error.h"

namespace grisaille::app {
namespace {

// As effect::Values::text() gives it: the shortest that reads back to the same number.
std::string numberText(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace

std::string tomlNodeText(const toml::node& node, std::string_view key, const std::string& place) {
  if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_floating_point()) return numberText(value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  if (const auto* value = node.as_string()) return value->get();
  throw Error(ErrorId::kSettingsInvalid, "{}: '{}' is not a number, a boolean or a string", place,
              key);
}

std::string tomlText(const std::string& text) {
  std::ostringstream out;
  out << toml::toml_formatter(toml::value<std::string>(text), toml::format_flags::none);
  return out.str();
}

std::string tomlValue(const std::string& text) {
  if (text == "true" || text == "false") return text;
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = status == std::errc() && end == text.data() + text.size();
  if (!whole || !std::isfinite(value) || numberText(value) != text) return tomlText(text);
  // TOML's whole numbers have 64 bits and no -0.
  const bool floating = text.find_first_of(".e") != std::string::npos;
  const bool integer = !floating && std::abs(value) < 9e18 && text != "-0";
  return floating || integer ? text : text + ".0";
}

}  // namespace grisaille::app
