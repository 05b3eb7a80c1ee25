// SPDX-License-Identifier: MIT
#include "app/viewer/pass_stats.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace grisaille::app::viewer {
namespace {

void append(std::vector<float>& recent, double milliseconds) {
  if (recent.size() == PassTimes::kFramesKept) recent.erase(recent.begin());
  recent.push_back(static_cast<float>(milliseconds));
}

PassStats statsOf(const std::string& label, const std::vector<float>& recent) {
  PassStats stats{.label = label, .recent = recent, .mean = 0, .p95 = 0};
  if (recent.empty()) return stats;
  const size_t count = recent.size();
  stats.mean = std::accumulate(recent.begin(), recent.end(), 0.0) / static_cast<double>(count);
  std::vector<float> sorted = recent;
  const size_t rank = (95 * count + 99) / 100;  // counted from 1
  const auto at = sorted.begin() + static_cast<ptrdiff_t>(rank - 1);
  std::nth_element(sorted.begin(), at, sorted.end());
  stats.p95 = *at;
  return stats;
}

}  // namespace

void PassTimes::add(const gpu::FrameTimes& frame) {
  std::vector<Pass> next;
  std::vector<double> sums;
  for (const gpu::PassTime& pass : frame.passes) {
    const auto known = std::ranges::find(next, pass.label, &Pass::label);
    if (known != next.end()) {
      sums[static_cast<size_t>(known - next.begin())] += pass.milliseconds;
      continue;
    }
    const auto old = std::ranges::find(passes_, pass.label, &Pass::label);
    next.push_back({pass.label, old == passes_.end() ? std::vector<float>() : old->recent});
    sums.push_back(pass.milliseconds);
  }
  for (size_t i = 0; i < next.size(); ++i) append(next[i].recent, sums[i]);
  append(whole_, frame.wholeMilliseconds);
  append(sums_, std::accumulate(sums.begin(), sums.end(), 0.0));
  passes_ = std::move(next);
}

std::vector<PassStats> PassTimes::all() const {
  std::vector<PassStats> all;
  for (const Pass& pass : passes_) all.push_back(statsOf(pass.label, pass.recent));
  return all;
}

PassStats PassTimes::whole() const {
  return statsOf("frame", whole_);
}

PassStats PassTimes::sum() const {
  return statsOf("sum of passes", sums_);
}

std::string costCsv(std::span<const PassStats> columns) {
  std::string text = "frame number";
  size_t frames = 0;
  for (const PassStats& column : columns) {
    text += fmt::format(",{} ms", column.label);
    frames = std::max(frames, column.recent.size());
  }
  text += '\n';
  for (size_t i = 0; i < frames; ++i) {
    text += fmt::format("{}", i + 1);
    for (const PassStats& column : columns) {
      const size_t missing = frames - column.recent.size();
      text += i < missing ? "," : fmt::format(",{:.4f}", column.recent[i - missing]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace grisaille::app::viewer
