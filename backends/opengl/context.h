// SPDX-License-Identifier: MIT
// An OpenGL context of EGL, without a window or a window's own. No header of this folder sees an
// API header: EGL's handles are pointers and OpenGL's names 32-bit numbers.
#pragma once

#include "backends/window.h"

namespace grisaille::opengl {

enum class ContextKind {
  kCore,   // 4.5 core
  kDebug,  // the same with debug output
  kAny,    // whatever the driver gives: to name a device that is too old
};

class Context {
 public:
  // Another program's, which is current whenever this is used.
  Context() : display_(nullptr), foreign_(true) {}
  // Throws kDeviceFailed. `display` is an initialised EGLDisplay.
  Context(void* display, ContextKind kind);
  // Borrows the window's own, of EGL, and makes it current. Throws kDeviceFailed.
  explicit Context(backends::Window& window);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Cheap when it is current on this thread already. Throws kDeviceFailed, as when another thread
  // holds it.
  void makeCurrent();

  // Shows what is drawn in the window. Waits for the display when it is a picture ahead. False: the
  // window refuses. Throws kDeviceLost.
  bool swap();

 private:
  void* display_;
  void* context_ = nullptr;
  void* surface_ = nullptr;  // null: no window
  bool foreign_ = false;
};

// Puts the calling thread's current context back.
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
