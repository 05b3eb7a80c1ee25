// SPDX-License-Identifier: MIT
#include "backends/glfw/window.h"

#include <epoxy/egl.h>
#include <vulkan/vulkan.h>
// After the APIs' headers, whose types it then uses.
#define GLFW_EXPOSE_NATIVE_EGL
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>

#include <cstdlib>

namespace grisaille::glfw {
namespace {

void hintOpenGl(bool check) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, check ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_ALPHA_BITS, 0);  // nothing behind the window shows through
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);  // pictures come encoded
  glfwWindowHint(GLFW_DOUBLEBUFFER, GLFW_TRUE);
}

}  // namespace

void choosePlatform() {
#ifdef GLFW_PLATFORM_X11  // since 3.4; before, there is one platform
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  const bool none = wayland == nullptr || *wayland == '\0';
  if (none && std::getenv("DISPLAY") != nullptr) {
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
  }
#endif
}

void hintWindow(std::string_view backend, bool check) {
  glfwDefaultWindowHints();
  if (backend == "opengl") {
    hintOpenGl(check);
  } else {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  }
}

Window::Size Window::size() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  if (width <= 0 || height <= 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0) return {};
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

Window::EglHandles Window::makeEglCurrent() {
  const EglHandles handles = {.display = glfwGetEGLDisplay(),
                              .context = glfwGetEGLContext(window_),
                              .surface = glfwGetEGLSurface(window_)};
  // Not by EGL alone, since GLFW has to know it for the swap interval.
  if (handles.context != nullptr) {
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
  }
  return handles;
}

std::span<const char* const> Window::instanceExtensions() const {
  uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return names == nullptr ? std::span<const char* const>() : std::span{names, count};
}

int Window::createSurface(void* instance, void* surface) {
  return glfwCreateWindowSurface(static_cast<VkInstance>(instance), window_, nullptr,
                                 static_cast<VkSurfaceKHR*>(surface));
}

}  // namespace grisaille::glfw
