// SPDX-License-Identifier: MIT
// Measures the time of every pass. Hardware drivers use GPU timestamps, read once they are
// available. Software drivers take timestamps before the work is done, so the timer reads the wall
// clock between two glFinish() calls.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "backends/opengl/objects.h"
#include "core/gpu/types.h"

namespace grisaille::opengl {

class PassTimer {
 public:
  // kNone measures nothing. The context must stay current for the timer's lifetime.
  explicit PassTimer(gpu::Clock clock) : clock_(clock) {}

  void beginPass(std::string_view label);
  void endPass();

  // End the frame: submit() keeps its passes, drop() discards them.
  void submit(uint64_t frame);
  void drop();

  // Reads the timestamps that are available, without waiting.
  void collect();

  // Returns the frames finished since the last call, oldest first.
  std::vector<gpu::FrameTimes> take();

 private:
  struct Pass {
    std::string label;
    std::chrono::steady_clock::time_point wallBegin, wallEnd;
    Object begin, end;  // timestamp queries
  };
  struct Frame {
    uint64_t number = 0;
    std::vector<Pass> passes;
  };

  Object stamp();
  bool arrived(const Frame& frame) const;
  gpu::FrameTimes timesOf(const Frame& frame) const;
  void recycle(Frame& frame);

  gpu::Clock clock_;
  std::vector<Pass> current_;
  std::deque<Frame> pending_;
  std::vector<gpu::FrameTimes> done_;
  std::vector<Object> spares_;
};

}  // namespace grisaille::opengl
