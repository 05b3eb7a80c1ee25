// SPDX-License-Identifier: MIT
#include "backends/opengl/readback.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>

#include "backends/opengl/formats.h"

namespace grisaille::opengl {
namespace {

using gpu::Access;

// A staging buffer in memory that the CPU reads fast. Without it, drivers move the resource itself
// to such memory and print a message about it.
class Staging {
 public:
  explicit Staging(uint64_t size) : size_(size), object_(ObjectKind::kBuffer) {
    allocateStorage("buffer", "readback", size, [&] {
      glNamedBufferStorage(object_.name(), static_cast<GLsizeiptr>(size), nullptr,
                           GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT);
    });
  }

  GLuint name() const { return object_.name(); }

  std::vector<std::byte> contents() const {
    std::vector<std::byte> bytes(size_);
    const void* memory =
        glMapNamedBufferRange(object_.name(), 0, static_cast<GLsizeiptr>(size_), GL_MAP_READ_BIT);
    if (memory == nullptr) {
      throw Error(ErrorId::kOutOfDeviceMemory, "cannot map {} bytes to read them back", size_);
    }
    std::memcpy(bytes.data(), memory, size_);
    glUnmapNamedBuffer(object_.name());
    return bytes;
  }

 private:
  uint64_t size_;
  Object object_;
};

}  // namespace

std::vector<std::byte> readTexture(Resources& resources, gpu::Texture texture, uint32_t mip,
                                   uint32_t layer) {
  const TextureResource& resource = resources.textures.get(texture);
  const gpu::TextureDesc& desc = resource.desc;
  resources.tracker.use(
      {.texture = texture, .mip = mip, .mipCount = 1, .layer = layer, .layerCount = 1},
      Access::kCopyRead);
  resources.barriers();
  const uint32_t width = std::max(1u, desc.width >> mip);
  const uint32_t height = std::max(1u, desc.height >> mip);
  const uint64_t size = uint64_t{width} * height * gpu::formatInfo(desc.format).texelBytes;
  const Staging staging(size);
  const GlFormat& format = glFormat(desc.format);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, staging.name());
  glGetTextureSubImage(resource.object.name(), static_cast<GLint>(mip), 0, 0,
                       static_cast<GLint>(layer), static_cast<GLsizei>(width),
                       static_cast<GLsizei>(height), 1, format.transferFormat, format.transferType,
                       static_cast<GLsizei>(size), nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  return staging.contents();
}

std::vector<std::byte> readBuffer(Resources& resources, gpu::BufferRange range) {
  const BufferResource& buffer = resources.buffers.get(range.buffer);
  resources.tracker.use(range.buffer, Access::kCopyRead);
  resources.barriers();
  const uint64_t size = range.size == 0 ? buffer.size - range.offset : range.size;
  const Staging staging(size);
  glCopyNamedBufferSubData(buffer.object.name(), staging.name(),
                           static_cast<GLintptr>(range.offset), 0, static_cast<GLsizeiptr>(size));
  return staging.contents();
}

}  // namespace grisaille::opengl
