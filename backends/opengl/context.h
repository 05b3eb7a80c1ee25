// SPDX-License-Identifier: MIT
// An OpenGL context of EGL without a window. No header of this folder sees an API header: EGL's
// handles are pointers and OpenGL's names 32-bit numbers.
#pragma once

namespace grisaille::opengl {

enum class ContextKind {
  kCore,   // 4.5 core
  kDebug,  // the same with debug output
  kAny,    // whatever the driver gives: to name a device that is too old
};

class Context {
 public:
  // Throws kDeviceFailed. `display` is an initialised EGLDisplay.
  Context(void* display, ContextKind kind);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Cheap when it is current on this thread already. Throws kDeviceFailed, as when another thread
  // holds it.
  void makeCurrent();

 private:
  void* display_;
  void* context_;
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
