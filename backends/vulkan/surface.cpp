// SPDX-License-Identifier: MIT
#include "backends/vulkan/surface.h"

namespace grisaille::vulkan {

std::span<const char* const> surfaceExtensions(const backends::Window& window) {
  const std::span<const char* const> names = window.instanceExtensions();
  if (names.empty()) {
    throw Error(ErrorId::kBackendMissing, "no installed Vulkan driver can present to a window");
  }
  return names;
}

Surface::Surface(const Instance& instance, backends::Window* window)
    : instance_(instance), window_(window) {
  renew();
}

Surface::~Surface() {
  if (surface_ != VK_NULL_HANDLE) functions().destroy(instance_.handle(), surface_, nullptr);
}

void Surface::renew() {
  if (surface_ != VK_NULL_HANDLE) functions().destroy(instance_.handle(), surface_, nullptr);
  surface_ = VK_NULL_HANDLE;
  check(static_cast<VkResult>(window_->createSurface(instance_.handle(), &surface_)),
        "creating the window's surface (was the window created for Vulkan?)");
}

VkExtent2D Surface::size() const {
  const backends::Window::Size size = window_->size();
  return {size.width, size.height};
}

}  // namespace grisaille::vulkan
