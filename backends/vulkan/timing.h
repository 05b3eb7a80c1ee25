// SPDX-License-Identifier: MIT
// Times of one frame's passes, by the device's timestamps or by the wall clock.
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

  // The wall clock is read when a pass begins and ends: before and after, the caller waits for the
  // device.
  bool wall() const { return clock_ == gpu::Clock::kWall; }

  void beginFrame(uint64_t frame);
  void beginPass(VkCommandBuffer commands, std::string_view label);
  void endPass(VkCommandBuffer commands);

  // The times of a frame that the device has finished; nothing when it is collected already.
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
  uint32_t stamps_ = 0;  // two a pass
};

}  // namespace grisaille::vulkan
