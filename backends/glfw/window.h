// SPDX-License-Identifier: MIT
// GLFW's windows as the backends see them. Only programs that open windows link this room.
#pragma once

#include <string_view>

#include "backends/window.h"

struct GLFWwindow;

namespace grisaille::glfw {

// Before glfwInit(): GLFW 3.4 looks for a Wayland compositor first, and libwayland prints an error
// where there is none. Without WAYLAND_DISPLAY, X11 is taken at once.
void choosePlatform();

// Sets all of GLFW's hints to what the window of a device of this backend needs. `check` as in
// DeviceOptions. The caller adds its own hints and makes the window.
void hintWindow(std::string_view backend, bool check);

class Window : public backends::Window {
 public:
  // Borrows the window, which was made after hintWindow() and outlives this.
  explicit Window(GLFWwindow* window) : window_(window) {}

  Size size() const override;
  EglHandles makeEglCurrent() override;
  std::span<const char* const> instanceExtensions() const override;
  int createSurface(void* instance, void* surface) override;

 private:
  GLFWwindow* window_;
};

}  // namespace grisaille::glfw
