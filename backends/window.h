// SPDX-License-Identifier: MIT
// The window interface that a device uses. The library that opened the window implements it. It
// includes no API header: handles are void pointers, and comments name their types.
#pragma once

#include <cstdint>
#include <span>

namespace grisaille::backends {

// Belongs to the main thread and outlives its device.
class Window {
 public:
  struct Size {
    uint32_t width = 0, height = 0;  // pixels
  };
  struct EglHandles {
    void* display = nullptr;  // EGLDisplay
    void* context = nullptr;  // EGLContext
    void* surface = nullptr;  // EGLSurface
  };

  virtual ~Window() = default;

  // The size of a picture that fills the window; 0 x 0 while the window is iconified.
  virtual Size size() const = 0;

  // Makes the window's own OpenGL context current, with a swap interval of 1, and returns its
  // handles. They are null if EGL did not create that context.
  virtual EglHandles makeEglCurrent() = 0;

  // The Vulkan instance extensions that surfaces need. Empty if no installed driver can present to
  // a window. The names live as long as the window library.
  virtual std::span<const char* const> instanceExtensions() const = 0;

  // Creates a surface for `instance`, a VkInstance, and stores it at `surface`, a VkSurfaceKHR*.
  // The caller destroys it. Returns a VkResult.
  virtual int createSurface(void* instance, void* surface) = 0;
};

}  // namespace grisaille::backends
