// SPDX-License-Identifier: MIT
// The time of every pass. By the GPU's own stamps on hardware, read when they have arrived; on
// software drivers, whose stamps are taken before the work is done, by the wall clock between two
// waits.
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
  // kNone times nothing. The context stays current through the timer's life.
  explicit PassTimer(gpu::Clock clock) : clock_(clock) {}

  void beginPass(std::string_view label);
  void endPass();

  // The frame's end: keeps its passes, or forgets them.
  void submit(uint64_t frame);
  void drop();

  // Takes the stamps that have arrived, without a wait.
  void collect();

  // The finished frames since the last call, oldest first.
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
