// SPDX-License-Identifier: MIT
#include "backends/vulkan/timing.h"

#include <algorithm>

namespace grisaille::vulkan {

PassTimer::~PassTimer() {
  for (const VkQueryPool pool : pools_) {
    context_.vk.vkDestroyQueryPool(context_.device, pool, context_.callbacks);
  }
}

void PassTimer::beginFrame(uint64_t frame) {
  if (clock_ == gpu::Clock::kNone) return;
  frame_ = frame;
  passes_.clear();
  stamps_ = 0;
}

void PassTimer::beginPass(VkCommandBuffer commands, std::string_view label) {
  if (clock_ == gpu::Clock::kNone) return;
  if (clock_ == gpu::Clock::kGpu) stamp(commands);
  passes_.push_back({std::string(label), Wall::now(), {}});
}

void PassTimer::endPass(VkCommandBuffer commands) {
  if (clock_ == gpu::Clock::kNone) return;
  if (clock_ == gpu::Clock::kGpu) stamp(commands);
  passes_.back().end = Wall::now();
}

// Both timestamps of a pass wait for all earlier work: the passes' times add up to the frame's.
void PassTimer::stamp(VkCommandBuffer commands) {
  const VolkDeviceTable& vk = context_.vk;
  const uint32_t pool = stamps_ / kPoolStamps, query = stamps_ % kPoolStamps;
  if (pool == pools_.size()) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kPoolStamps;
    pools_.reserve(pools_.size() + 1);
    VkQueryPool made = VK_NULL_HANDLE;
    check(vk.vkCreateQueryPool(context_.device, &info, context_.callbacks, &made),
          "vkCreateQueryPool");
    pools_.push_back(made);
  }
  if (query == 0) vk.vkCmdResetQueryPool(commands, pools_[pool], 0, kPoolStamps);
  vk.vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pools_[pool], query);
  ++stamps_;
}

std::optional<gpu::FrameTimes> PassTimer::collect() {
  if (!frame_) return std::nullopt;
  gpu::FrameTimes times;
  times.frame = *frame_;
  frame_.reset();
  if (passes_.empty()) return times;
  for (const Pass& pass : passes_) times.passes.push_back({pass.label, 0});
  if (wall()) {
    collectWall(times);
  } else {
    collectStamps(times);
  }
  return times;
}

void PassTimer::collectWall(gpu::FrameTimes& times) const {
  const auto milliseconds = [](Wall::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
  };
  for (size_t i = 0; i < passes_.size(); ++i) {
    times.passes[i].milliseconds = milliseconds(passes_[i].end - passes_[i].begin);
  }
  times.wholeMilliseconds = milliseconds(passes_.back().end - passes_.front().begin);
}

void PassTimer::collectStamps(gpu::FrameTimes& times) const {
  std::vector<uint64_t> stamps(stamps_);
  for (uint32_t first = 0; first < stamps_; first += kPoolStamps) {
    const uint32_t count = std::min(kPoolStamps, stamps_ - first);
    check(context_.vk.vkGetQueryPoolResults(context_.device, pools_[first / kPoolStamps], 0, count,
                                            count * sizeof(uint64_t), stamps.data() + first,
                                            sizeof(uint64_t),
                                            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
  }
  const uint32_t bits = context_.timestampBits;
  const uint64_t valid = bits >= 64 ? UINT64_MAX : (uint64_t{1} << bits) - 1;
  const auto milliseconds = [&](uint64_t begin, uint64_t end) {
    // timestampPeriod is nanoseconds per tick. The counter may wrap once between the timestamps.
    return static_cast<double>((end - begin) & valid) *
           static_cast<double>(context_.properties.limits.timestampPeriod) * 1e-6;
  };
  for (size_t i = 0; i < passes_.size(); ++i) {
    times.passes[i].milliseconds = milliseconds(stamps[2 * i], stamps[2 * i + 1]);
  }
  times.wholeMilliseconds = milliseconds(stamps.front(), stamps.back());
}

}  // namespace grisaille::vulkan
