// SPDX-License-Identifier: MIT
// A window as the place where pictures are shown.
#pragma once

#include "backends/opengl/context.h"
#include "backends/opengl/resources.h"
#include "backends/window.h"

namespace grisaille::opengl {

class Window {
 public:
  explicit Window(backends::Window* window) : window_(window) {}

  // Device::present(), in the window's context, which is current.
  bool show(Context& context, Resources& resources, gpu::Texture picture);

 private:
  backends::Window* window_;
  int width_ = 0, height_ = 0;  // pixels, at the last swap
};

}  // namespace grisaille::opengl
