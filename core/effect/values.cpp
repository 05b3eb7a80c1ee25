// SPDX-License-Identifier: MIT
#include "core/effect/values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/error.h"
#include "core/base/nearest.h"

namespace grisaille::effect {
namespace {

std::string number(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string quoted(std::string_view text) {
  return '"' + oneLine(text) + '"';
}

std::span<const char* const> entries(const grisaille_param_desc& param) {
  return {param.enum_keys, param.enum_count};
}

[[noreturn]] void throwEnum(const std::string& name, const grisaille_param_desc& param,
                            std::string_view text) {
  const std::vector<std::string> keys(entries(param).begin(), entries(param).end());
  const std::string near = nearest(text, keys);
  std::string all;
  for (const std::string& key : keys) all += (all.empty() ? "" : ", ") + key;
  throw Error(ErrorId::kParameterRange, "{} has no entry {}{}; it has {}", name, quoted(text),
              near.empty() ? "" : ", nearest is " + near, all);
}

double parseBool(const std::string& name, std::string_view text) {
  if (text == "true" || text == "on" || text == "1") return 1;
  if (text == "false" || text == "off" || text == "0") return 0;
  throw Error(ErrorId::kParameterType, "{} is {}, neither true nor false", name, quoted(text));
}

double parseEnum(const std::string& name, const grisaille_param_desc& param,
                 std::string_view text) {
  const auto keys = entries(param);
  const auto found = std::ranges::find(keys, text);
  if (found == keys.end()) throwEnum(name, param, text);
  return static_cast<double>(found - keys.begin());
}

double parseNumber(const std::string& name, const grisaille_param_desc& param,
                   std::string_view text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || status == std::errc::invalid_argument) {
    throw Error(ErrorId::kParameterType, "{} is {}, which is not a number", name, quoted(text));
  }
  if (status == std::errc::result_out_of_range) {
    throw Error(ErrorId::kParameterRange, "{} is {}, beyond the range of a double; give {} to {}",
                name, quoted(text), number(param.hard_min), number(param.hard_max));
  }
  return value;
}

// Throws unless the parameter may have the value.
void checkValue(const std::string& name, const grisaille_param_desc& param, double value) {
  if (!std::isfinite(value)) {
    throw Error(ErrorId::kParameterType, "{} is {}, which is not a finite number", name, value);
  }
  if (param.type != GRISAILLE_PARAM_FLOAT && value != std::trunc(value)) {
    throw Error(ErrorId::kParameterType, "{} is {}, which is not whole; nearest is {}", name,
                number(value),
                number(std::clamp(std::round(value), param.hard_min, param.hard_max)));
  }
  if (value < param.hard_min || value > param.hard_max) {
    const bool under = value < param.hard_min;
    throw Error(ErrorId::kParameterRange, "{} is {}, {} the {} allowed value; nearest is {}{}{}",
                name, number(value), under ? "under" : "over", under ? "least" : "greatest",
                number(under ? param.hard_min : param.hard_max), *param.unit != '\0' ? " " : "",
                param.unit);
  }
}

}  // namespace

std::string textOf(const grisaille_param_desc& param, double value) {
  switch (param.type) {
    case GRISAILLE_PARAM_BOOL:
      return value != 0 ? "true" : "false";
    case GRISAILLE_PARAM_ENUM:
      return entries(param)[static_cast<size_t>(value)];
    case GRISAILLE_PARAM_INT:
      return std::to_string(static_cast<int64_t>(value));
    default:
      return number(value);
  }
}

std::optional<std::pair<std::string, std::string>> usedWhen(const Effect& effect,
                                                            const grisaille_param_desc& param) {
  if (param.used_when_key == nullptr) return std::nullopt;
  const auto params = effect.params();
  const auto other =
      std::ranges::find(params, std::string_view(param.used_when_key), &grisaille_param_desc::key);
  return std::pair(other->key, textOf(*other, param.used_when_value));
}

std::string usedWhenText(const Effect& effect, const grisaille_param_desc& param) {
  const auto condition = usedWhen(effect, param);
  return condition ? condition->first + " = " + condition->second : "";
}

Values::Values(const Effect& effect) : effect_(effect) {
  for (const grisaille_param_desc& param : effect.params()) {
    defaults_.push_back(param.default_value);
  }
  reset();
}

size_t Values::indexOf(std::string_view key) const {
  const auto params = effect_.params();
  const auto found = std::ranges::find_if(params, [&](const auto& p) { return key == p.key; });
  if (found != params.end()) return static_cast<size_t>(found - params.begin());
  std::vector<std::string> keys;
  for (const grisaille_param_desc& param : params) keys.emplace_back(param.key);
  const std::string near = nearest(key, keys);
  throw Error(ErrorId::kParameterUnknown, "effect {} has no parameter {}{}", effect_.desc->key,
              quoted(key), near.empty() ? "" : ", nearest is " + near);
}

void Values::set(std::string_view key, std::string_view text) {
  const grisaille_param_desc& param = effect_.params()[indexOf(key)];
  const std::string name = fmt::format("{}.{}", effect_.desc->key, param.key);
  switch (param.type) {
    case GRISAILLE_PARAM_BOOL:
      return set(key, parseBool(name, text));
    case GRISAILLE_PARAM_ENUM:
      return set(key, parseEnum(name, param, text));
    default:
      return set(key, parseNumber(name, param, text));
  }
}

void Values::set(std::string_view key, double value) {
  const size_t index = indexOf(key);
  const grisaille_param_desc& param = effect_.params()[index];
  checkValue(fmt::format("{}.{}", effect_.desc->key, param.key), param, value);
  values_[index] = value;
  given_[index] = true;
}

void Values::fit(std::string_view key, double value) {
  const size_t index = indexOf(key);
  const grisaille_param_desc& param = effect_.params()[index];
  checkValue(fmt::format("{}.{}", effect_.desc->key, param.key), param, value);
  defaults_[index] = value;
  if (!given_[index]) values_[index] = value;
}

void Values::reset(std::string_view key) {
  const size_t index = indexOf(key);
  values_[index] = defaults_[index];
  given_[index] = false;
}

void Values::reset() {
  values_ = defaults_;
  given_.assign(defaults_.size(), false);
}

std::string Values::text(std::string_view key) const {
  const size_t index = indexOf(key);
  return textOf(effect_.params()[index], values_[index]);
}

bool Values::isUsed(const grisaille_param_desc& param) const {
  return param.used_when_key == nullptr ||
         get(param.used_when_key) == static_cast<double>(param.used_when_value);
}

}  // namespace grisaille::effect
