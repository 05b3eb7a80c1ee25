// SPDX-License-Identifier: MIT
#include "backends/glfw/window.h"

#include <epoxy/egl.h>
#include <vulkan/vulkan.h>
// Include after the API headers: GLFW then uses their types.
#define GLFW_EXPOSE_NATIVE_EGL
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>

#include <cstdlib>

// GLFW's header declares it beside functions that need more libraries' headers. Weak: a GLFW that
// is built for Wayland alone lacks it.
extern "C" __attribute__((weak)) unsigned long glfwGetX11Window(GLFWwindow* window);

namespace grisaille::glfw {
namespace {

void hintOpenGl(bool check) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, check ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_ALPHA_BITS, 0);  // the window is opaque
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);  // pictures are sRGB encoded already
  glfwWindowHint(GLFW_DOUBLEBUFFER, GLFW_TRUE);
}

}  // namespace

void choosePlatform() {
#ifdef GLFW_PLATFORM_X11  // GLFW 3.4 and later; older versions have a single platform
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

unsigned long x11Window(GLFWwindow* window) {
  if (glfwGetX11Window == nullptr) return 0;
  const unsigned long number = glfwGetX11Window(window);
  if (number == 0) glfwGetError(nullptr);  // another platform is no error
  return number;
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
  // Through GLFW instead of EGL: glfwSwapInterval() needs a context that GLFW knows as current.
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
