// SPDX-License-Identifier: MIT
// The window as a device sees it. The library that opened the window implements this interface.
// It includes no API header: handles are void pointers, and comments name their types.
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

  // Of the picture that fills the window; 0 x 0 while it is iconified.
  virtual Size size() const = 0;

  // The window's own OpenGL context, which this call makes current, with a swap interval of 1. Null
  // handles: the window has none of EGL.
  virtual EglHandles makeEglCurrent() = 0;

  // The Vulkan instance extensions that surfaces need; empty: no driver here shows pictures in a
  // window. The names live as long as the window library.
  virtual std::span<const char* const> instanceExtensions() const = 0;

  // Makes a surface of a VkInstance and stores it at `surface`, a VkSurfaceKHR*. The caller
  // destroys it. Returns a VkResult.
  virtual int createSurface(void* instance, void* surface) = 0;
};

}  // namespace grisaille::backends
