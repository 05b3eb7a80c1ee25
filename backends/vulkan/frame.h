// SPDX-License-Identifier: MIT
// The objects that one frame in flight owns.
#pragma once

#include "backends/vulkan/arena.h"
#include "backends/vulkan/descriptors.h"
#include "backends/vulkan/timeline.h"
#include "backends/vulkan/timing.h"

namespace grisaille::vulkan {

// A command buffer with its own pool.
class CommandBuffer {
 public:
  explicit CommandBuffer(Context& context);
  ~CommandBuffer();
  CommandBuffer(const CommandBuffer&) = delete;
  CommandBuffer& operator=(const CommandBuffer&) = delete;

  // Discards the recorded commands and begins again. The device must have finished with them.
  void begin();
  uint64_t submit(Timeline& timeline, const ImageSemaphores& image = {});

  VkCommandBuffer handle() const { return commands_; }

 private:
  Context& context_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

// The memory, descriptors and timer of a frame; reset when the device has finished the frame.
struct Recording {
  Recording(Context& context, Resources& resources, gpu::Clock clock)
      : arena(context, resources), descriptors(context), timer(context, clock) {}

  void reset() {
    arena.reset();
    descriptors.reset();
  }

  // Allocates what a frame like `other` needs.
  void prepareLike(const Recording& other) {
    arena.prepare();
    descriptors.prepareLike(other.descriptors);
  }

  Arena arena;
  DescriptorPools descriptors;
  PassTimer timer;
};

struct Frame {
  Frame(Context& context, Resources& resources, gpu::Clock clock)
      : commands(context), recording(context, resources, clock) {}

  CommandBuffer commands;
  Recording recording;
  uint64_t done = 0;  // the timeline's count when the device has finished with it
};

}  // namespace grisaille::vulkan
