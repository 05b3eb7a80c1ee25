// SPDX-License-Identifier: MIT
// The name of a parameter on the command line, in files and in reports: "ssao.radius".
#pragma once

#include <algorithm>
#include <compare>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace grisaille::effect {

inline bool isKeyLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

// Whether the text is a key: a-z, 0-9, _, beginning with a-z.
inline bool isKey(std::string_view text) {
  return !text.empty() && text.front() >= 'a' && text.front() <= 'z' &&
         std::ranges::all_of(text, isKeyLetter);
}

struct ParameterName {
  std::string effect, key;

  std::string text() const { return effect + "." + key; }
  auto operator<=>(const ParameterName&) const = default;
};

// "ssao.radius=0.5"
struct Assignment {
  ParameterName name;
  std::string value;  // in the form of the command line

  std::string text() const { return name.text() + "=" + value; }
  auto operator<=>(const Assignment&) const = default;
};

// A parameter's value as a number: see grisaille_param_desc.
struct ParameterValue {
  ParameterName name;
  double value = 0;

  bool operator==(const ParameterValue&) const = default;
};

// Throws kUsage.
inline ParameterName parseParameterName(std::string_view text) {
  const size_t dot = text.find('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == text.size()) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form EFFECT.PARAMETER", oneLine(text));
  }
  return {.effect = std::string(text.substr(0, dot)), .key = std::string(text.substr(dot + 1))};
}

// Throws kUsage.
inline Assignment parseAssignment(std::string_view text) {
  const size_t dot = text.find('.'), equals = text.find('=');
  if (dot == std::string_view::npos || equals == std::string_view::npos || equals < dot) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form EFFECT.PARAMETER=VALUE", oneLine(text));
  }
  return {.name = {.effect = std::string(text.substr(0, dot)),
                   .key = std::string(text.substr(dot + 1, equals - dot - 1))},
          .value = std::string(text.substr(equals + 1))};
}

}  // namespace grisaille::effect
