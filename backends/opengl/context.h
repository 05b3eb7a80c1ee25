// SPDX-License-Identifier: MIT
// An OpenGL context that EGL creates: a context without a window, or a window's own. No header of
// this folder includes an API header: EGL handles are pointers, OpenGL names 32-bit numbers.
#pragma once

#include "backends/window.h"

namespace grisaille::opengl {

enum class ContextKind {
  kCore,   // 4.5 core
  kDebug,  // the same with debug output
  kAny,    // any version that the driver offers: to read the name of a device that is too old
};

class Context {
 public:
  // Stands for another program's context, which must be current whenever this object is used.
  Context() : display_(nullptr), foreign_(true) {}
  // Throws kDeviceFailed. `display` is an initialised EGLDisplay.
  Context(void* display, ContextKind kind);
  // Borrows the window's own EGL context and makes it current. Throws kDeviceFailed.
  explicit Context(backends::Window& window);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Cheap if the context is already current on this thread. Throws kDeviceFailed, for example if
  // the context is current on another thread.
  void makeCurrent();

  // Swaps the window's buffers. Waits for the display when it is one picture ahead. Returns false
  // if EGL refuses the swap. Throws kDeviceLost.
  bool swap();

 private:
  void* display_;
  void* context_ = nullptr;
  void* surface_ = nullptr;  // null: no window
  bool foreign_ = false;
};

// Restores the calling thread's current context in its destructor.
class CurrentContextGuard {
 public:
  CurrentContextGuard();
  ~CurrentContextGuard();
  CurrentContextGuard(const CurrentContextGuard&) = delete;
  CurrentContextGuard& operator=(const CurrentContextGuard&) = delete;

 private:
  void* display_;
  void* context_;
  void* draw_;
  void* read_;
};

}  // namespace grisaille::opengl
