// SPDX-License-Identifier: MIT
// A window as Vulkan sees it.
#pragma once

#include <span>

#include "backends/vulkan/instance.h"

struct GLFWwindow;

namespace grisaille::vulkan {

// The instance extensions that GLFW's windows need. Throws kBackendMissing.
std::span<const char* const> surfaceExtensions();

class Surface {
 public:
  // The window was made with hintWindow(). Throws kDeviceFailed.
  Surface(const Instance& instance, GLFWwindow* window);
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
  GLFWwindow* window_;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
};

}  // namespace grisaille::vulkan
