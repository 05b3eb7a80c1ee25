// SPDX-License-Identifier: MIT
// Presents pictures in a window.
#pragma once

#include "backends/opengl/context.h"
#include "backends/opengl/resources.h"
#include "backends/window.h"

namespace grisaille::opengl {

class Window {
 public:
  explicit Window(backends::Window* window) : window_(window) {}

  // Implements Device::present(). The window's context must be current.
  bool show(Context& context, Resources& resources, gpu::Texture picture);

 private:
  backends::Window* window_;
  int width_ = 0, height_ = 0;  // pixels, at the last swap
};

}  // namespace grisaille::opengl
