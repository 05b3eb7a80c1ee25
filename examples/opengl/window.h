// SPDX-License-Identifier: MIT
// An OpenGL 4.5 context: of a hidden window, or of none where there is no display.
#pragma once

struct GLFWwindow;

namespace example {

class Window {
 public:
  Window();  // the context is current then
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

 private:
  GLFWwindow* window_ = nullptr;  // null: without a display
  void* display_ = nullptr;       // EGL's then
  void* context_ = nullptr;
};

}  // namespace example
