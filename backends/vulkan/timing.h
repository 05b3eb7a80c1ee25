// SPDX-License-Identifier: MIT
// Measures the passes of one frame, by the device's timestamps or by the wall clock.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "backends/vulkan/context.h"

namespace grisaille::vulkan {

class PassTimer {
 public:
  // Clock::kNone: every call does nothing.
  PassTimer(Context& context, gpu::Clock clock) : context_(context), clock_(clock) {}
  ~PassTimer();
  PassTimer(const PassTimer&) = delete;
  PassTimer& operator=(const PassTimer&) = delete;

  // Whether passes are timed by the wall clock. The caller must then wait for the device before
  // beginPass() and endPass().
  bool wall() const { return clock_ == gpu::Clock::kWall; }

  void beginFrame(uint64_t frame);
  void beginPass(VkCommandBuffer commands, std::string_view label);
  void endPass(VkCommandBuffer commands);

  // The times of the frame, which the device must have finished; none if already collected.
  std::optional<gpu::FrameTimes> collect();
  void drop() { frame_.reset(); }

 private:
  using Wall = std::chrono::steady_clock;
  static constexpr uint32_t kPoolStamps = 128;

  struct Pass {
    std::string label;
    Wall::time_point begin, end;
  };

  void stamp(VkCommandBuffer commands);
  void collectWall(gpu::FrameTimes& times) const;
  void collectStamps(gpu::FrameTimes& times) const;

  Context& context_;
  gpu::Clock clock_;
  std::optional<uint64_t> frame_;
  std::vector<Pass> passes_;
  std::vector<VkQueryPool> pools_;
  uint32_t stamps_ = 0;  // timestamps written, two per pass
};

}  // namespace grisaille::vulkan
