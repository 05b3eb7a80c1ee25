// SPDX-License-Identifier: MIT
#include "backends/opengl/current_context.h"

#include <dlfcn.h>

#include <atomic>

namespace grisaille::opengl {
namespace {

using Current = void* (*)();

// Queries one window system for the current context. It does not load the system's library: a
// program with a context has loaded it already.
struct System {
  const char* libraries[2];  // null: no second one
  const char* function;
  std::atomic<Current> found = nullptr;

  void* context() {
    Current ask = found.load(std::memory_order_relaxed);
    for (const char* name : libraries) {
      if (ask != nullptr || name == nullptr) break;
      void* library = dlopen(name, RTLD_LAZY | RTLD_NOLOAD);
      if (library == nullptr) continue;
      ask = reinterpret_cast<Current>(dlsym(library, function));
      found.store(ask, std::memory_order_relaxed);
      // The library stays open, because `found` points into it.
    }
    return ask != nullptr ? ask() : nullptr;
  }
};

}  // namespace

void* currentContext() {
  static System egl{{"libEGL.so.1", nullptr}, "eglGetCurrentContext"};
  static System glx{{"libGLX.so.0", "libGL.so.1"}, "glXGetCurrentContext"};
  void* context = egl.context();
  return context != nullptr ? context : glx.context();
}

}  // namespace grisaille::opengl
