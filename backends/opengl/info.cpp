// SPDX-License-Identifier: MIT
#include "backends/opengl/info.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace grisaille::opengl {
namespace {

// OpenGL has no query for the largest buffer, and drivers keep sizes in 31 bits.
constexpr uint64_t kMaxBufferBytes = 0x7fffffff;

uint32_t integer(GLenum what) {
  GLint value = 0;
  glGetIntegerv(what, &value);
  return static_cast<uint32_t>(std::max(0, value));
}

gpu::Capabilities readCapabilities() {
  gpu::Capabilities caps;
  caps.maxTextureSize = std::min({integer(GL_MAX_TEXTURE_SIZE), integer(GL_MAX_FRAMEBUFFER_WIDTH),
                                  integer(GL_MAX_FRAMEBUFFER_HEIGHT)});
  caps.maxTextureLayers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
  caps.maxBufferBytes = kMaxBufferBytes;
  GLint64 range = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &range);
  caps.maxStorageRange = std::min(static_cast<uint64_t>(range), kMaxBufferBytes);
  caps.maxUniformRange = integer(GL_MAX_UNIFORM_BLOCK_SIZE);
  caps.uniformAlignment = integer(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT);
  caps.storageAlignment = integer(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT);
  for (GLuint axis = 0; axis < 3; ++axis) {
    GLint groups = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &groups);
    caps.maxGroups[axis] = static_cast<uint32_t>(groups);
  }
  if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &caps.maxAnisotropy);
  }
  return caps;
}

gpu::Clock chooseClock(bool software) {
  GLint bits = 0;
  glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  return software || bits == 0 ? gpu::Clock::kWall : gpu::Clock::kGpu;
}

}  // namespace

gpu::DeviceInfo readInfo(const gpu::ListedDevice& device) {
  return {.backend = "opengl",
          .name = device.name,
          .driver = device.driver,
          .software = device.software,
          .clock = chooseClock(device.software),
          .capabilities = readCapabilities()};
}

}  // namespace grisaille::opengl
