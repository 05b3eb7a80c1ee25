// SPDX-License-Identifier: MIT
// Implements backends::Window with GLFW. Only programs that open windows link this library.
#pragma once

#include <string_view>

#include "backends/window.h"

struct GLFWwindow;

namespace grisaille::glfw {

// Call it before glfwInit(). Chooses X11 if DISPLAY is set and WAYLAND_DISPLAY is not: GLFW 3.4
// looks for a Wayland compositor first, and libwayland prints an error if none runs.
void choosePlatform();

// Sets all GLFW window hints to the values that a device of this backend needs. `check`: same as
// DeviceOptions::check. The caller adds its own hints and creates the window.
void hintWindow(std::string_view backend, bool check);

// The window's number on its X server; 0 on other platforms.
unsigned long x11Window(GLFWwindow* window);

class Window : public backends::Window {
 public:
  // `window` must have been created after hintWindow(), and must outlive this object.
  explicit Window(GLFWwindow* window) : window_(window) {}

  Size size() const override;
  EglHandles makeEglCurrent() override;
  std::span<const char* const> instanceExtensions() const override;
  int createSurface(void* instance, void* surface) override;

 private:
  GLFWwindow* window_;
};

}  // namespace grisaille::glfw
