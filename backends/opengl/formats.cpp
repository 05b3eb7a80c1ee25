// SPDX-License-Identifier: MIT
#include "backends/opengl/formats.h"

#include <epoxy/gl.h>

namespace grisaille::opengl {

const GlFormat& glFormat(gpu::Format format) {
  static constexpr GlFormat kFormats[] = {
      {GL_NONE, GL_NONE, GL_NONE},
      {GL_R8, GL_RED, GL_UNSIGNED_BYTE},
      {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
      {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE},
      {GL_R16F, GL_RED, GL_HALF_FLOAT},
      {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT},
      {GL_R32F, GL_RED, GL_FLOAT},
      {GL_RG32F, GL_RG, GL_FLOAT},
      {GL_RGBA32F, GL_RGBA, GL_FLOAT},
      {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT},
      {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT},
  };
  return kFormats[static_cast<size_t>(format)];
}

}  // namespace grisaille::opengl
