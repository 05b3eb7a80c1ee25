// SPDX-License-Identifier: MIT
#include "backends/vulkan/surface.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "backends/vulkan/vulkan.h"

namespace grisaille::vulkan {

void hintWindow(bool /*check*/) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
}

std::span<const char* const> surfaceExtensions() {
  uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) {
    throw Error(ErrorId::kBackendMissing, "no Vulkan driver here shows pictures in a window");
  }
  return {names, count};
}

Surface::Surface(const Instance& instance, GLFWwindow* window)
    : instance_(instance), window_(window) {
  renew();
}

Surface::~Surface() {
  if (surface_ != VK_NULL_HANDLE) functions().destroy(instance_.handle(), surface_, nullptr);
}

void Surface::renew() {
  if (surface_ != VK_NULL_HANDLE) functions().destroy(instance_.handle(), surface_, nullptr);
  surface_ = VK_NULL_HANDLE;
  check(glfwCreateWindowSurface(instance_.handle(), window_, nullptr, &surface_),
        "glfwCreateWindowSurface (was the window made for Vulkan?)");
}

VkExtent2D Surface::size() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  if (width <= 0 || height <= 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0) return {};
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

}  // namespace grisaille::vulkan
