// SPDX-License-Identifier: MIT
// The metrics that expectations compare, by name.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/trace/flicker.h"

namespace grisaille::lab::claims {

// The frames that a metric is computed from.
enum class Over : uint8_t { kFirst, kAll, kLast };

struct MetricInfo {
  const char* key;
  const char* meaning;  // for reports
  Over over;            // kAll and kLast need more than one frame
  bool timed;           // depends on the machine as well as the settings
};

// Every metric that a claim can name.
std::span<const MetricInfo> metrics();

// Null if no metric has this name.
const MetricInfo* findMetric(std::string_view key);

// The results of a run, one element per frame of its camera path. Pictures have one channel.
struct Evidence {
  std::vector<trace::FlickerFrame>& frames;      // the rays' hits; metrics overwrite ao and truth
  std::span<const image::Image> shown;           // the measured output
  std::span<const image::Image> reference;       // the truth, or another run's output
  std::span<const std::vector<uint8_t>> region;  // 1: the pixel counts
};

// NaN if no pixel counts. `metric` is the key of a metric that is not timed.
double measured(std::string_view metric, const Evidence& evidence);

}  // namespace grisaille::lab::claims
