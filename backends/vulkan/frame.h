// SPDX-License-Identifier: MIT
// What one frame in flight owns.
#pragma once

#include "backends/vulkan/arena.h"
#include "backends/vulkan/descriptors.h"
#include "backends/vulkan/timeline.h"
#include "backends/vulkan/timing.h"

namespace grisaille::vulkan {

// A command buffer with its pool.
class CommandBuffer {
 public:
  explicit CommandBuffer(Context& context);
  ~CommandBuffer();
  CommandBuffer(const CommandBuffer&) = delete;
  CommandBuffer& operator=(const CommandBuffer&) = delete;

  // Drops what was recorded; the device has finished with it.
  void begin();
  uint64_t submit(Timeline& timeline, const ImageSemaphores& image = {});

  VkCommandBuffer handle() const { return commands_; }

 private:
  Context& context_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

struct Frame {
  Frame(Context& context, Resources& resources, gpu::Clock clock)
      : commands(context), arena(context, resources), descriptors(context), timer(context, clock) {}

  CommandBuffer commands;
  Arena arena;
  DescriptorPools descriptors;
  PassTimer timer;
  uint64_t done = 0;  // the timeline's count when the device has finished with it
};

}  // namespace grisaille::vulkan
