// SPDX-License-Identifier: MIT
// Numbers that claims are made of, by name.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/trace/flicker.h"

namespace grisaille::lab::claims {

struct MetricInfo {
  const char* key;
  const char* meaning;  // for reports
  bool alongPath;       // over all frames of a camera path; else of the first frame alone
  bool timed;           // of the machine as much as of the setting
};

// Every metric that a claim can name.
std::span<const MetricInfo> metrics();

// Null: there is none of this name.
const MetricInfo* findMetric(std::string_view key);

// What a run showed, one element a frame of its camera path. Pictures have one channel.
struct Evidence {
  std::vector<trace::FlickerFrame>& frames;      // the rays' hits; `ao` and `truth` are used up
  std::span<const image::Image> shown;           // what is measured
  std::span<const image::Image> reference;       // what is right
  std::span<const std::vector<uint8_t>> region;  // 1: the pixel counts
};

// NaN where no pixel counts. `metric` is one of metrics() and not timed.
double measured(std::string_view metric, const Evidence& evidence);

}  // namespace grisaille::lab::claims
