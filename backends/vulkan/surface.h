// SPDX-License-Identifier: MIT
// A window's Vulkan surface.
#pragma once

#include <span>

#include "backends/vulkan/instance.h"
#include "backends/window.h"

namespace grisaille::vulkan {

// The instance extensions that the window's surface needs. Throws kBackendMissing.
std::span<const char* const> surfaceExtensions(const backends::Window& window);

class Surface {
 public:
  // The window must have been created for Vulkan. Throws kDeviceFailed.
  Surface(const Instance& instance, backends::Window* window);
  ~Surface();
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  // Recreates the surface after VK_ERROR_SURFACE_LOST_KHR. Nothing may still use the old one.
  // Throws kDeviceFailed.
  void renew();

  VkSurfaceKHR handle() const { return surface_; }
  const SurfaceFunctions& functions() const { return instance_.surface(); }

  // The window's size in pixels; 0 while the window is iconified.
  VkExtent2D size() const;

 private:
  const Instance& instance_;
  backends::Window* window_;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
};

}  // namespace grisaille::vulkan
