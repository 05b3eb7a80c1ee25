// SPDX-License-Identifier: MIT
#include "app/study/sweep.h"

#include <algorithm>
#include <charconv>

#include "core/base/error.h"
#include "core/effect/values.h"

namespace grisaille::app::study {

Sweep parseSweep(const effect::Registry& registry, const std::string& text) {
  const size_t dot = text.find('.'), equals = text.find('=');
  if (dot == std::string::npos || equals == std::string::npos || equals < dot ||
      equals + 1 == text.size()) {
    throw Error(ErrorId::kUsage, "--sweep '{}' is not of the form EFFECT.PARAMETER=VALUE,...",
                text);
  }
  Sweep sweep{text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), {}};
  effect::Values values(registry.find(sweep.effect));
  for (size_t from = equals + 1; from <= text.size();) {
    const size_t end = std::min(text.find(',', from), text.size());
    values.set(sweep.key, text.substr(from, end - from));
    std::string value = values.text(sweep.key);
    if (std::ranges::find(sweep.values, value) != sweep.values.end()) {
      throw Error(ErrorId::kUsage, "--sweep '{}' names {} twice", text, value);
    }
    sweep.values.push_back(std::move(value));
    from = end + 1;
  }
  return sweep;
}

std::vector<Setting> gridOf(const std::vector<Sweep>& sweeps) {
  std::vector<Setting> grid(1);
  for (const Sweep& sweep : sweeps) {
    const std::string name = sweep.effect + "." + sweep.key;
    const bool twice = std::ranges::any_of(grid[0], [&](const auto& v) { return v.first == name; });
    if (twice) throw Error(ErrorId::kUsage, "{} is swept twice", name);
    if (grid.size() * sweep.values.size() > kMostSettings) {
      throw Error(ErrorId::kUsage, "the sweeps make more than {} settings", kMostSettings);
    }
    std::vector<Setting> wider;
    for (const Setting& setting : grid) {
      for (const std::string& value : sweep.values) {
        wider.push_back(setting);
        wider.back().emplace_back(name, value);
      }
    }
    grid = std::move(wider);
  }
  return grid;
}

std::string nameOf(const Setting& setting) {
  std::string text;
  for (const auto& [name, value] : setting) {
    text += (text.empty() ? "" : " ") + name.substr(name.find('.') + 1) + "=" + value;
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
    throw Error(ErrorId::kUsage, "--shard '{}' is not I/N with I from 1 to N", text);
  }
  return shard;
}

}  // namespace grisaille::app::study
