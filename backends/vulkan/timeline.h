// SPDX-License-Identifier: MIT
// Submits to the queue. A timeline semaphore counts the submissions that have finished.
#pragma once

#include "backends/vulkan/context.h"

namespace grisaille::vulkan {

// Semaphores of one swapchain image; null for work that is not presented.
struct ImageSemaphores {
  VkSemaphore acquired = VK_NULL_HANDLE;  // clears and blits wait for it
  VkSemaphore drawn = VK_NULL_HANDLE;     // signalled at the end
};

class Timeline {
 public:
  explicit Timeline(Context& context);
  ~Timeline();
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  // Returns the count that completed() reaches when this submission has finished.
  uint64_t submit(VkCommandBuffer commands, const ImageSemaphores& image = {});

  uint64_t submitted() const { return submitted_; }
  uint64_t completed() const;

  // Throws kDeviceLost.
  void wait(uint64_t count) const;

 private:
  Context& context_;
  VkSemaphore semaphore_ = VK_NULL_HANDLE;
  uint64_t submitted_ = 0;
};

}  // namespace grisaille::vulkan
