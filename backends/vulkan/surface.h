// SPDX-License-Identifier: MIT
// A window as Vulkan sees it.
#pragma once

#include <span>

#include "backends/vulkan/instance.h"
#include "backends/window.h"

namespace grisaille::vulkan {

// The instance extensions that the window's surface needs. Throws kBackendMissing.
std::span<const char* const> surfaceExtensions(const backends::Window& window);

class Surface {
 public:
  // The window was made for Vulkan. Throws kDeviceFailed.
  Surface(const Instance& instance, backends::Window* window);
  ~Surface();
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  // After VK_ERROR_SURFACE_LOST_KHR; nothing uses it any more. Throws kDeviceFailed.
  void renew();

  VkSurfaceKHR handle() const { return surface_; }
  const SurfaceFunctions& functions() const { return instance_.surface(); }

  // The window's area, in pixels; 0 while it is iconified.
  VkExtent2D size() const;

 private:
  const Instance& instance_;
  backends::Window* window_;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
};

}  // namespace grisaille::vulkan
