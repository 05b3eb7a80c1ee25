// SPDX-License-Identifier: MIT
#include "backends/opengl/context.h"

#include <epoxy/egl.h>

#include <vector>

#include "core/base/error.h"

namespace grisaille::opengl {
namespace {

EGLContext createContext(EGLDisplay display, ContextKind kind, bool resetNotification) {
  std::vector<EGLint> attributes;
  if (kind != ContextKind::kAny) {
    attributes = {EGL_CONTEXT_MAJOR_VERSION_KHR,       4,
                  EGL_CONTEXT_MINOR_VERSION_KHR,       5,
                  EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR};
  }
  if (kind == ContextKind::kDebug) {
    attributes.insert(attributes.end(), {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
  }
  if (resetNotification) {
    attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_KHR,
                                         EGL_LOSE_CONTEXT_ON_RESET_KHR});
  }
  attributes.push_back(EGL_NONE);
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

Context::Context(void* display, ContextKind kind) : display_(display) {
  for (const char* needed :
       {"EGL_KHR_create_context", "EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"}) {
    if (!epoxy_has_egl_extension(display, needed)) {
      throw Error(ErrorId::kDeviceFailed, "EGL lacks {}", needed);
    }
  }
  eglBindAPI(EGL_OPENGL_API);
  // A driver may advertise reset notification and still refuse it for this kind of context.
  if (kind != ContextKind::kAny &&
      epoxy_has_egl_extension(display, "EGL_EXT_create_context_robustness")) {
    context_ = createContext(display, kind, true);
  }
  if (context_ == nullptr) context_ = createContext(display, kind, false);
  if (context_ == nullptr) {
    throw Error(ErrorId::kDeviceFailed, "EGL cannot create an OpenGL{} context (error {:#x})",
                kind == ContextKind::kAny ? "" : " 4.5 core", eglGetError());
  }
}

Context::Context(backends::Window& window) {
  const backends::Window::EglHandles handles = window.makeEglCurrent();
  display_ = handles.display;
  context_ = handles.context;
  surface_ = handles.surface;
  if (display_ == EGL_NO_DISPLAY || context_ == EGL_NO_CONTEXT || surface_ == EGL_NO_SURFACE) {
    throw Error(ErrorId::kDeviceFailed, "the window has no OpenGL context that EGL created");
  }
  makeCurrent();
}

Context::~Context() {
  if (foreign_) return;
  if (eglGetCurrentContext() == context_) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  if (surface_ != nullptr) return;  // the window's owner destroys it
  eglDestroyContext(display_, context_);
}

void Context::makeCurrent() {
  if (foreign_ || eglGetCurrentContext() == context_) return;
  eglBindAPI(EGL_OPENGL_API);
  if (eglMakeCurrent(display_, surface_, surface_, context_)) return;
  const EGLint error = eglGetError();
  throw Error(
      ErrorId::kDeviceFailed, "EGL cannot make the context current on this thread: {}",
      error == EGL_BAD_ACCESS ? "another thread uses it" : fmt::format("error {:#x}", error));
}

bool Context::swap() {
  if (eglSwapBuffers(display_, surface_)) return true;
  const EGLint error = eglGetError();
  if (error != EGL_CONTEXT_LOST) return false;
  throw Error(ErrorId::kDeviceLost, "EGL lost the window's context");
}

CurrentContextGuard::CurrentContextGuard()
    : display_(eglGetCurrentDisplay()),
      context_(eglGetCurrentContext()),
      draw_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)) {}

CurrentContextGuard::~CurrentContextGuard() {
  if (context_ == eglGetCurrentContext()) return;
  if (context_ != EGL_NO_CONTEXT) {
    eglMakeCurrent(display_, draw_, read_, context_);
  } else {
    eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
}

}  // namespace grisaille::opengl
