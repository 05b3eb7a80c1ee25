// SPDX-License-Identifier: MIT
#include "backends/opengl/window.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace grisaille::opengl {

namespace {

// Copies the picture unscaled to the window's top left corner; pixels beyond it are black.
void copy(Resources& resources, gpu::Texture picture, int width, int height) {
  const TextureResource& texture = resources.textures.get(picture);
  const GLint right = std::min(width, static_cast<GLint>(texture.desc.width));
  const GLint rows = std::min(height, static_cast<GLint>(texture.desc.height));
  const GLuint source = resources.framebuffer({Attachment{.texture = texture.object.name()}});
  resources.tracker.use({.texture = picture, .mip = 0, .mipCount = 1, .layer = 0, .layerCount = 1},
                        gpu::Access::kCopyRead);
  resources.barriers();
  glDisable(GL_FRAMEBUFFER_SRGB);  // a window may be sRGB although GLFW did not request it
  if (right < width || rows < height) {
    constexpr GLfloat kBlack[] = {0, 0, 0, 1};
    glClearNamedFramebufferfv(0, GL_COLOR, 0, kBlack);
  }
  // A window's row 0 is its bottom one.
  glBlitNamedFramebuffer(source, 0, 0, 0, right, rows, 0, height, right, height - rows,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glEnable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace

// A driver may update the window's size only after a swap. The first picture at a new size is then
// misplaced, and show() draws it again.
bool Window::show(Context& context, Resources& resources, gpu::Texture picture) {
  constexpr int kAttempts = 3;  // at most, if the size keeps changing
  bool settled = false;
  for (int i = 0; i < kAttempts && !settled; ++i) {
    const backends::Window::Size size = window_->size();
    if (size.width == 0 || size.height == 0) return false;
    const int width = static_cast<int>(size.width), height = static_cast<int>(size.height);
    copy(resources, picture, width, height);
    if (!context.swap()) return false;
    settled = width == width_ && height == height_;
    width_ = width;
    height_ = height;
  }
  return true;
}

}  // namespace grisaille::opengl
