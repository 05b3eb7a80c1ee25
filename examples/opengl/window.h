// SPDX-License-Identifier: MIT
// An OpenGL 4.5 context: of a hidden window, or without a window if the machine has no display.
#pragma once

struct GLFWwindow;

namespace example {

class Window {
 public:
  Window();  // makes the context current; throws std::runtime_error
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

 private:
  GLFWwindow* window_ = nullptr;  // null: no display
  void* display_ = nullptr;       // of EGL, without a display
  void* context_ = nullptr;       // of EGL, without a display
};

}  // namespace example
