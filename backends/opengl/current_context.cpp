// SPDX-License-Identifier: MIT
#include "backends/opengl/current_context.h"

#include <dlfcn.h>

#include <atomic>

namespace grisaille::opengl {
namespace {

using Current = void* (*)();

// One window system's question. Its library is not loaded for it: who has a context has loaded it.
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
      // Kept open, so that the function stays.
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
