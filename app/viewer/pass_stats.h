// SPDX-License-Identifier: MIT
// Times of each pass in the last frames: mean and 95th percentile.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/gpu/types.h"

namespace grisaille::app::viewer {

struct PassStats {
  std::string label;
  std::vector<float> recent;  // milliseconds, oldest first, at most kFramesKept
  double mean = 0;            // milliseconds
  double p95 = 0;             // milliseconds; 95th percentile, nearest rank
};

class PassTimes {
 public:
  static constexpr size_t kFramesKept = 240;

  // Adds one frame. Sums passes with the same label. Drops passes that this frame does not have.
  void add(const gpu::FrameTimes& frame);
  void add(std::span<const gpu::FrameTimes> frames) {
    for (const gpu::FrameTimes& frame : frames) add(frame);
  }

  // One entry per pass, in the order of the last frame.
  std::vector<PassStats> all() const;

  // The times of whole frames, labelled "frame".
  PassStats whole() const;
  // The sum of each frame's passes, labelled "sum of passes".
  PassStats sum() const;

  void clear() { *this = {}; }

 private:
  struct Pass {
    std::string label;
    std::vector<float> recent;
  };

  std::vector<Pass> passes_;
  std::vector<float> whole_, sums_;
};

// The frames of `columns` as CSV, oldest first: a line of labels, then one line a frame with
// milliseconds. A pass that is newer than the oldest frame has empty fields there.
std::string costCsv(std::span<const PassStats> columns);

}  // namespace grisaille::app::viewer
