// SPDX-License-Identifier: MIT
// The grid of settings that a study measures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/effect/parameter_name.h"
#include "core/effect/registry.h"

namespace grisaille::app::study {

// One parameter's values, in the order they were given.
struct Sweep {
  effect::ParameterName name;
  std::vector<double> values;
};

// "ssao.kernel_size=4,8,16". Throws kUsage, kEffectUnknown, kParameter*; a value that stands twice
// is kUsage.
Sweep parseSweep(const effect::Registry& registry, const std::string& text);

// One value a sweep, in the sweeps' order.
using Setting = std::vector<effect::ParameterValue>;

// The same for people and files.
using SettingText = std::vector<effect::Assignment>;
SettingText textOf(const effect::Registry& registry, const Setting& setting);

// Every combination, the last sweep's values the fastest. Throws kUsage where a parameter is swept
// twice or there are more than kMostSettings.
constexpr size_t kMostSettings = 100000;
std::vector<Setting> gridOf(const std::vector<Sweep>& sweeps);

// "kernel_size=8 radius=0.5"; "defaults" for none.
std::string nameOf(const SettingText& setting);

// Part I of N: every N-th setting from the I-th on, so that parts cost much the same.
struct Shard {
  uint32_t index = 1, count = 1;
  bool holds(size_t setting) const { return setting % count == index - 1; }
};

// "2/8". Throws kUsage.
Shard parseShard(const std::string& text);

}  // namespace grisaille::app::study
