// SPDX-License-Identifier: MIT
// The swapchain of a window, and the copies of pictures to its images.
#pragma once

#include <array>
#include <vector>

#include "backends/vulkan/frame.h"

namespace grisaille::vulkan {

class Swapchain {
 public:
  // `context` must have a surface. The images are created when they are first needed.
  Swapchain(Context& context, Resources& resources, Timeline& timeline);
  ~Swapchain();  // the device must be idle
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  // Implements Device::present().
  bool show(gpu::Texture picture);

 private:
  static constexpr uint32_t kInFlight = 2;  // copies in flight

  struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkSemaphore drawn = VK_NULL_HANDLE;  // presentation waits for it
  };
  struct Copy {
    explicit Copy(Context& context) : commands(context) {}
    CommandBuffer commands;
    VkSemaphore acquired = VK_NULL_HANDLE;
    uint64_t done = 0;  // the timeline's count when the device has finished with it
  };

  bool make(VkExtent2D window);
  VkResult create(VkExtent2D window, VkSwapchainKHR& made);
  void fill();
  void clear();
  void loseSurface();
  VkSurfaceFormatKHR chooseFormat() const;
  VkSemaphore makeSemaphore(const char* label);
  void record(VkCommandBuffer commands, gpu::Texture picture, VkImage image);
  void barrier(VkCommandBuffer commands, VkImageMemoryBarrier2 barrier, VkImage image);
  bool queue(uint32_t index);

  Context& context_;
  Resources& resources_;
  Timeline& timeline_;
  Surface& surface_;
  std::array<Copy, kInFlight> copies_;
  uint64_t shown_ = 0;  // number of copies begun
  VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
  std::vector<Image> images_;
  VkExtent2D window_{};  // the window's size when the images were created
  VkExtent2D extent_{};  // the images' size: the window's, unless the surface fixes another
  bool stale_ = true;    // the images must be recreated
};

}  // namespace grisaille::vulkan
