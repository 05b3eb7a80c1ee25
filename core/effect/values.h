// SPDX-License-Identifier: MIT
// The values of one effect's parameters, set by key and text and checked against its table. A
// parameter that nobody has set has its default: the table's, or the one that fit() chose.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/effect/registry.h"

namespace grisaille::effect {

// A valid value of the parameter, in the form that Values::set() reads back without loss.
std::string textOf(const grisaille_param_desc& param, double value);

// Another parameter of the effect, and the only value of it (see textOf()) with which `param` is
// used; none: it is always used.
std::optional<std::pair<std::string, std::string>> usedWhen(const Effect& effect,
                                                            const grisaille_param_desc& param);
// "estimator = classic", or "".
std::string usedWhenText(const Effect& effect, const grisaille_param_desc& param);

class Values {
 public:
  explicit Values(const Effect& effect);  // all default values of the table

  const Effect& effect() const { return effect_; }
  std::span<const double> all() const { return values_; }

  // Index of a key. Throws kParameterUnknown with the nearest key.
  size_t indexOf(std::string_view key) const;
  double get(std::string_view key) const { return values_[indexOf(key)]; }

  // `text` as on the command line: a number, true|false|on|off|1|0, the key of an enum entry.
  // Throws kParameterUnknown, kParameterType, kParameterRange (naming the nearest valid value), and
  // then leaves the value unchanged.
  void set(std::string_view key, std::string_view text);
  void set(std::string_view key, double value);

  // Replaces the default of a parameter. Changes its value only if nobody has set it. Throws as
  // set() does.
  void fit(std::string_view key, double value);
  // Back to the default, as if nobody had set it.
  void reset(std::string_view key);
  void reset();  // all parameters
  // Whether somebody has set it.
  bool given(std::string_view key) const { return given_[indexOf(key)]; }
  double defaultOf(std::string_view key) const { return defaults_[indexOf(key)]; }

  // The value in the form that set() reads back without loss.
  std::string text(std::string_view key) const;

  // Whether the effect's other values let it use the parameter.
  bool isUsed(const grisaille_param_desc& param) const;

 private:
  Effect effect_;
  std::vector<double> values_, defaults_;
  std::vector<bool> given_;
};

}  // namespace grisaille::effect
