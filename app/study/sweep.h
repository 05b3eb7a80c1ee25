// SPDX-License-Identifier: MIT
// The grid of settings that a study measures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/effect/parameter_name.h"
#include "core/effect/registry.h"

namespace grisaille::app::study {

// The values of one parameter, in the order of the command line.
struct Sweep {
  effect::ParameterName name;
  std::vector<double> values;
};

// Parses "ssao.kernel_size=4,8,16". Throws kUsage (also for a value given twice), kEffectUnknown,
// kParameter*.
Sweep parseSweep(const effect::Registry& registry, const std::string& text);

// One value per sweep, in the order of the sweeps.
using Setting = std::vector<effect::ParameterValue>;

// A setting with its values as text, for people and files.
using SettingText = std::vector<effect::Assignment>;
SettingText textOf(const effect::Registry& registry, const Setting& setting);

// Every combination of the sweeps' values; the last sweep varies fastest. Throws kUsage if a
// parameter is swept twice or there are more than kMostSettings combinations.
constexpr size_t kMostSettings = 100000;
std::vector<Setting> gridOf(const std::vector<Sweep>& sweeps);

// The settings of a file: each line is a grid of its own, the sweeps of which stand between spaces.
// A line that begins with # is a comment. Throws kSettingsUnreadable, kSettingsInvalid for a file
// without settings or with one twice, and as parseSweep() and gridOf() do, with FILE:LINE before
// the message.
std::vector<Setting> loadGrids(const effect::Registry& registry, const std::string& file);

// "kernel_size=8 radius=0.5"; "defaults" for a setting without values.
std::string nameOf(const SettingText& setting);

// Part I of N: every N-th setting from the I-th on, so that all parts cost about the same.
struct Shard {
  uint32_t index = 1, count = 1;
  bool holds(size_t setting) const { return setting % count == index - 1; }
};

// Parses "2/8". Throws kUsage.
Shard parseShard(const std::string& text);

}  // namespace grisaille::app::study
