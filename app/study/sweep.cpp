// SPDX-License-Identifier: MIT
#include "app/study/sweep.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "core/base/error.h"
#include "core/effect/values.h"

namespace grisaille::app::study {

Sweep parseSweep(const effect::Registry& registry, const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size() || text.find('.') > equals) {
    throw Error(ErrorId::kUsage, "--sweep '{}' is not of the form EFFECT.PARAMETER=VALUE,...",
                text);
  }
  Sweep sweep{effect::parseParameterName(text.substr(0, equals)), {}};
  effect::Values values(registry.find(sweep.name.effect));
  for (size_t from = equals + 1; from <= text.size();) {
    const size_t end = std::min(text.find(',', from), text.size());
    values.set(sweep.name.key, text.substr(from, end - from));
    const double value = values.get(sweep.name.key);
    if (std::ranges::find(sweep.values, value) != sweep.values.end()) {
      throw Error(ErrorId::kUsage, "--sweep '{}' names the value {} twice", text,
                  values.text(sweep.name.key));
    }
    sweep.values.push_back(value);
    from = end + 1;
  }
  return sweep;
}

SettingText textOf(const effect::Registry& registry, const Setting& setting) {
  SettingText text;
  for (const effect::ParameterValue& one : setting) {
    effect::Values values(registry.find(one.name.effect));
    values.set(one.name.key, one.value);
    text.push_back({.name = one.name, .value = values.text(one.name.key)});
  }
  return text;
}

std::vector<Setting> gridOf(const std::vector<Sweep>& sweeps) {
  std::vector<Setting> grid(1);
  for (const Sweep& sweep : sweeps) {
    const bool twice =
        std::ranges::any_of(grid[0], [&](const auto& v) { return v.name == sweep.name; });
    if (twice) throw Error(ErrorId::kUsage, "{} is swept twice", sweep.name.text());
    if (grid.size() * sweep.values.size() > kMostSettings) {
      throw Error(ErrorId::kUsage, "the sweeps give more than {} settings; sweep fewer values",
                  kMostSettings);
    }
    std::vector<Setting> wider;
    for (const Setting& setting : grid) {
      for (const double value : sweep.values) {
        wider.push_back(setting);
        wider.back().push_back({sweep.name, value});
      }
    }
    grid = std::move(wider);
  }
  return grid;
}

std::vector<Setting> loadGrids(const effect::Registry& registry, const std::string& file) {
  std::ifstream in(file);
  if (!in) {
    throw Error(ErrorId::kSettingsUnreadable, "{} cannot be opened; check its name", file);
  }
  std::vector<Setting> all;
  std::string line;
  for (size_t number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::vector<Sweep> sweeps;
    std::string word;
    try {
      while (words >> word && word[0] != '#') sweeps.push_back(parseSweep(registry, word));
      if (sweeps.empty()) continue;
      for (Setting& setting : gridOf(sweeps)) {
        if (std::ranges::find(all, setting) != all.end()) {
          throw Error(ErrorId::kSettingsInvalid, "{} is in a grid above too; leave it out of one",
                      nameOf(textOf(registry, setting)));
        }
        all.push_back(std::move(setting));
      }
    } catch (const Error& error) {
      throw Error(error.id(), "{}:{}: {}", file, number, error.detail());
    }
  }
  if (all.empty()) {
    throw Error(
        ErrorId::kSettingsInvalid,
        "{} has no settings; write EFFECT.PARAMETER=VALUE,... between spaces, a grid a line", file);
  }
  return all;
}

std::string nameOf(const SettingText& setting) {
  std::string text;
  for (const effect::Assignment& one : setting) {
    text += (text.empty() ? "" : " ") + one.name.key + "=" + one.value;
  }
  return text.empty() ? "defaults" : text;
}

Shard parseShard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, shard.count) : first;
  if (!slash || second.ec != std::errc() || second.ptr != end || shard.index < 1 ||
      shard.index > shard.count) {
    throw Error(ErrorId::kUsage, "--shard '{}' is not of the form I/N with I from 1 to N", text);
  }
  return shard;
}

}  // namespace grisaille::app::study
