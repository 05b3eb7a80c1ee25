// SPDX-License-Identifier: MIT
#include "backends/opengl/window.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "backends/opengl/opengl.h"

namespace grisaille::opengl {

void hintWindow(bool check) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, check ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_ALPHA_BITS, 0);  // what is drawn shows nothing of what is behind
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);  // pictures come encoded
  glfwWindowHint(GLFW_DOUBLEBUFFER, GLFW_TRUE);
}

namespace {

// Texel for pixel, to the top left corner; the rest is black.
void copy(Resources& resources, gpu::Texture picture, int width, int height) {
  const TextureResource& texture = resources.textures.get(picture);
  const GLint right = std::min(width, static_cast<GLint>(texture.desc.width));
  const GLint rows = std::min(height, static_cast<GLint>(texture.desc.height));
  const GLuint source = resources.framebuffer({Attachment{.texture = texture.object.name()}});
  resources.tracker.use({.texture = picture, .mip = 0, .mipCount = 1, .layer = 0, .layerCount = 1},
                        gpu::Access::kCopyRead);
  resources.barriers();
  glDisable(GL_FRAMEBUFFER_SRGB);  // for windows that are sRGB without having been asked to
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

// Drivers may look for the window's size once after a swap. Then the first picture at a new size
// lies wrong, so it is shown again.
bool Window::show(Context& context, Resources& resources, gpu::Texture picture) {
  constexpr int kAttempts = 3;  // while the size goes on changing
  bool settled = false;
  for (int i = 0; i < kAttempts && !settled; ++i) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    const bool iconified = glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0;
    if (width <= 0 || height <= 0 || iconified) return false;
    copy(resources, picture, width, height);
    if (!context.swap()) return false;
    settled = width == width_ && height == height_;
    width_ = width;
    height_ = height;
  }
  return true;
}

}  // namespace grisaille::opengl
