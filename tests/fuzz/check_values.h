// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/effect/values.h"
#include "tests/fuzz/fuzz.h"

namespace grisaille::fuzz {

// Requires that each value is valid for its parameter, and that its text parses back to it.
inline void requireSound(const effect::Values& values) {
  const auto params = values.effect().params();
  effect::Values again(values.effect());
  for (size_t i = 0; i < params.size(); ++i) {
    const double value = values.all()[i];
    require(std::isfinite(value) && value >= params[i].hard_min && value <= params[i].hard_max);
    require(params[i].type == GRISAILLE_PARAM_FLOAT || value == std::trunc(value));
    again.set(params[i].key, values.text(params[i].key));
    require(again.all()[i] == value);
  }
}

}  // namespace grisaille::fuzz
