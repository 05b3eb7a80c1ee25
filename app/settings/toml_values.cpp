// SPDX-License-Identifier: MIT
#include "app/settings/toml_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/base/error.h"
#include "core/base/regular_file.h"

namespace grisaille::app {
namespace {

// Same as effect::Values::text(): the shortest text that reads back to the same number.
std::string numberText(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

constexpr size_t kLargestFile = size_t{1} << 20;
// Each part of a dotted key is a nested table. toml++ destroys nested tables recursively without a
// limit. (It refuses arrays and inline tables from a depth of 256 on.)
constexpr size_t kMostKeyParts = 16;

// The end of the string with its first quote at `at`. A one-line string that is not closed ends
// with its line.
size_t endOfString(std::string_view text, size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool isLong = text.substr(at).starts_with(three);
  for (at += isLong ? 3 : 1; at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"') {
      ++at;
    } else if (!isLong && (text[at] == quote || text[at] == '\n')) {
      return at + 1;
    } else if (isLong && text.substr(at).starts_with(three)) {
      // Up to two quotes before the closing three belong to the string.
      const size_t end = std::min(text.find_first_not_of(quote, at + 3), at + 5);
      return std::min(end, text.size());
    }
  }
  return text.size();
}

void checkKeys(std::string_view text, const std::string& path) {
  size_t line = 1, dots = 0;
  for (size_t at = 0; at < text.size();) {
    const char c = text[at];
    size_t end = at + 1;
    if (c == '"' || c == '\'') {
      end = endOfString(text, at);
    } else if (c == '#') {
      end = std::min(text.find('\n', at), text.size());
    } else if (c == '.') {
      ++dots;
    } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
      dots = 0;
    }
    if (dots >= kMostKeyParts) {
      throw Error(ErrorId::kSettingsUnreadable, "{}:{}: a key has more than {} parts", path, line,
                  kMostKeyParts);
    }
    line += static_cast<size_t>(std::ranges::count(text.substr(at, end - at), '\n'));
    at = end;
  }
}

}  // namespace

toml::table parseTomlFile(const std::string& path) {
  const std::string text = readRegularFile(path, ErrorId::kSettingsUnreadable, kLargestFile);
  checkKeys(text, path);
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorId::kSettingsUnreadable, "{}:{}: {}", path, error.source().begin.line,
                error.description());
  }
}

std::string tomlNodeText(const toml::node& node, std::string_view key, const std::string& place) {
  if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_floating_point()) return numberText(value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  if (const auto* value = node.as_string()) return value->get();
  throw Error(ErrorId::kSettingsInvalid, "{}: '{}' must be a number, a boolean or a string", place,
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
  // TOML integers have 64 bits and no -0.
  const bool floating = text.find_first_of(".e") != std::string::npos;
  const bool integer = !floating && std::abs(value) < 9e18 && text != "-0";
  return floating || integer ? text : text + ".0";
}

}  // namespace grisaille::app
