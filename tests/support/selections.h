// SPDX-License-Identifier: MIT
// Selections of the test plugin's effects (plugins/tables.cpp), with random values.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <string>

#include "core/effect/selection.h"

namespace grisaille::tests {

// Registry of the test plugin in its current version ("now") or its later version ("later").
struct Tables {
  effect::Registry registry;

  explicit Tables(const std::string& version = "now") {
    registry.scan(PLUGINS "/" + version);
    for (const effect::Refused& refused : registry.refused()) throw refused.reason;
  }
};

// A random value in the parameter's range, of any magnitude and sign; whole numbers and -0 occur.
inline double randomValue(std::mt19937_64& random, const grisaille_param_desc& param) {
  if (param.type != GRISAILLE_PARAM_FLOAT) {
    const double share = static_cast<double>(random() >> 11) / 9007199254740992.0;
    const double value = param.hard_min + std::floor(share * (param.hard_max - param.hard_min + 1));
    return std::min(value, param.hard_max);
  }
  for (;;) {
    double value = std::bit_cast<double>(random());
    int exponent = 0;
    if (random() % 4 == 0) value = std::trunc(std::frexp(value, &exponent) * 1e19);
    if (random() % 16 == 0) value = std::copysign(0.0, value);
    if (value >= param.hard_min && value <= param.hard_max) return value;
  }
}

inline void randomise(std::mt19937_64& random, effect::Selection::Entry& entry) {
  entry.on = random() % 2 == 0;
  for (const grisaille_param_desc& param : entry.effect().params()) {
    if (random() % 3 != 0) entry.values.set(param.key, randomValue(random, param));
  }
}

inline void randomise(std::mt19937_64& random, effect::Selection& list) {
  for (effect::Selection::Entry& entry : list.entries()) randomise(random, entry);
  for (size_t i = 0; i < 3; ++i) {
    list.move(random() % list.entries().size(), random() % list.entries().size());
  }
}

// Whether both hold the same effects in the same order, with the same on/off state and bitwise
// equal values.
inline bool same(const effect::Selection::Entry& a, const effect::Selection::Entry& b) {
  return std::string_view(a.key()) == b.key() && a.on == b.on &&
         std::ranges::equal(a.values.all(), b.values.all(), [](double x, double y) {
           return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y);
         });
}

inline bool same(const effect::Selection& a, const effect::Selection& b) {
  return std::ranges::equal(a.entries(), b.entries(),
                            [](const auto& x, const auto& y) { return same(x, y); });
}

}  // namespace grisaille::tests
