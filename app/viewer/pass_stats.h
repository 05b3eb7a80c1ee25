// SPDX-License-Identifier: MIT
// What each pass cost in the last frames.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/gpu/types.h"

namespace grisaille::app::viewer {

struct PassStats {
  std::string label;
  std::vector<float> recent;  // milliseconds, oldest first, at most kFramesKept
  double mean = 0;            // of them
  double p95 = 0;             // of them, nearest rank: 95 % take no longer
};

class PassTimes {
 public:
  static constexpr size_t kFramesKept = 240;

  // Passes of one label in one frame count as one. What is not in this frame is forgotten.
  void add(const gpu::FrameTimes& frame);
  void add(std::span<const gpu::FrameTimes> frames) {
    for (const gpu::FrameTimes& frame : frames) add(frame);
  }

  // In the order of the last frame.
  std::vector<PassStats> all() const;

  // The frames themselves, labelled "frame".
  PassStats whole() const;

  void clear() { *this = {}; }

 private:
  struct Pass {
    std::string label;
    std::vector<float> recent;
  };

  std::vector<Pass> passes_;
  std::vector<float> whole_;
};

}  // namespace grisaille::app::viewer
