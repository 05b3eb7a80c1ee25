// SPDX-License-Identifier: MIT
#include "backends/opengl/resources.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "backends/opengl/debug_output.h"
#include "backends/opengl/formats.h"

namespace grisaille::opengl {
namespace {

using gpu::Access;

GLenum targetOf(bool arrayed) {
  return arrayed ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
}

GLint addressMode(gpu::Address address) {
  switch (address) {
    case gpu::Address::kClamp:
      return GL_CLAMP_TO_EDGE;
    case gpu::Address::kRepeat:
      return GL_REPEAT;
    case gpu::Address::kMirror:
      return GL_MIRRORED_REPEAT;
  }
  return GL_CLAMP_TO_EDGE;
}

GLint minFilter(gpu::Filter filter, gpu::Filter mipFilter) {
  if (mipFilter == gpu::Filter::kNearest) {
    return filter == gpu::Filter::kNearest ? GL_NEAREST_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_NEAREST;
  }
  return filter == gpu::Filter::kNearest ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR;
}

// The barrier bits after a shader writes a texture: they cover every use that the texture allows. A
// later read of another kind finds the texture in a read state and issues no barrier.
GLbitfield textureBits(gpu::TextureUsage usage) {
  // The framebuffer bit also covers the blit to a window.
  GLbitfield bits = GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;
  if (has(usage, gpu::TextureUsage::kSampled)) bits |= GL_TEXTURE_FETCH_BARRIER_BIT;
  if (has(usage, gpu::TextureUsage::kStorage)) bits |= GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
  return bits;
}

GLbitfield bufferBits(gpu::BufferUsage usage) {
  GLbitfield bits = GL_BUFFER_UPDATE_BARRIER_BIT;
  if (has(usage, gpu::BufferUsage::kVertex)) bits |= GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT;
  if (has(usage, gpu::BufferUsage::kIndex)) bits |= GL_ELEMENT_ARRAY_BARRIER_BIT;
  if (has(usage, gpu::BufferUsage::kUniform)) bits |= GL_UNIFORM_BARRIER_BIT;
  if (has(usage, gpu::BufferUsage::kStorage)) bits |= GL_SHADER_STORAGE_BARRIER_BIT;
  return bits;
}

void attach(GLuint framebuffer, GLenum point, const Attachment& attachment, bool array) {
  const auto mip = static_cast<GLint>(attachment.mip);
  if (array) {
    glNamedFramebufferTextureLayer(framebuffer, point, attachment.texture, mip,
                                   static_cast<GLint>(attachment.layer));
  } else {
    glNamedFramebufferTexture(framebuffer, point, attachment.texture, mip);
  }
}

bool isArray(GLuint texture) {
  GLint target = 0;
  glGetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
  return target == GL_TEXTURE_2D_ARRAY;
}

}  // namespace

uint64_t bytesOf(const gpu::TextureDesc& desc) {
  uint64_t bytes = 0;
  for (uint32_t mip = 0; mip < desc.mips; ++mip) {
    bytes += uint64_t{std::max(1u, desc.width >> mip)} * std::max(1u, desc.height >> mip);
  }
  return bytes * desc.layers * gpu::formatInfo(desc.format).texelBytes;
}

void allocateStorage(const char* kind, std::string_view label, uint64_t bytes,
                     const std::function<void()>& allocate) {
  const QuietDebugOutput quiet;
  glGetError();  // discards the error of an earlier call
  allocate();
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  throw Error(ErrorId::kOutOfDeviceMemory, "no memory for {} '{}' of {} bytes (OpenGL error {:#x})",
              kind, label, bytes, error);
}

gpu::Buffer Resources::createBuffer(const gpu::BufferDesc& desc) {
  BufferResource buffer{
      .object = Object(ObjectKind::kBuffer), .size = desc.size, .usage = desc.usage};
  allocateStorage("buffer", desc.label, desc.size, [&] {
    glNamedBufferStorage(buffer.object.name(), static_cast<GLsizeiptr>(desc.size), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
  });
  buffer.object.label(desc.label);
  const gpu::Buffer handle = buffers.add(std::move(buffer));
  use_.deviceBytes += desc.size;
  ++use_.allocations;
  tracker.add(handle);
  return handle;
}

gpu::Buffer Resources::createMapped(uint64_t size, std::byte*& memory) {
  constexpr GLbitfield kFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  BufferResource buffer{
      .object = Object(ObjectKind::kBuffer), .size = size, .usage = gpu::BufferUsage::kUniform};
  const auto bytes = static_cast<GLsizeiptr>(size);
  allocateStorage("buffer", "uniforms", size, [&] {
    glNamedBufferStorage(buffer.object.name(), bytes, nullptr, kFlags);
    memory = static_cast<std::byte*>(glMapNamedBufferRange(buffer.object.name(), 0, bytes, kFlags));
  });
  buffer.object.label("uniforms");
  const gpu::Buffer handle = buffers.add(std::move(buffer));
  use_.hostBytes += size;
  ++use_.allocations;
  return handle;
}

gpu::Texture Resources::createTexture(const gpu::TextureDesc& desc) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (std::max(desc.width, desc.height) > static_cast<uint32_t>(most)) {
    throw Error(ErrorId::kTextureSize,
                "texture '{}' has {}x{} texels, and OpenGL allows {} per side", desc.label,
                desc.width, desc.height, most);
  }
  const bool array = desc.layers > 1;
  TextureResource texture{.object = Object::texture(targetOf(array)), .desc = desc, .views = {}};
  texture.desc.label = {};
  const GLuint name = texture.object.name();
  const auto mips = static_cast<GLsizei>(desc.mips), width = static_cast<GLsizei>(desc.width),
             height = static_cast<GLsizei>(desc.height), layers = static_cast<GLsizei>(desc.layers);
  const GLenum format = glFormat(desc.format).internalFormat;
  allocateStorage("texture", desc.label, bytesOf(desc), [&] {
    if (array) {
      glTextureStorage3D(name, mips, format, width, height, layers);
    } else {
      glTextureStorage2D(name, mips, format, width, height);
    }
  });
  texture.object.label(desc.label);
  const gpu::Texture handle = textures.add(std::move(texture));
  use_.deviceBytes += bytesOf(desc);
  ++use_.allocations;
  tracker.add(handle, desc.mips, desc.layers);
  return handle;
}

gpu::Sampler Resources::createSampler(const gpu::SamplerDesc& desc) {
  SamplerResource sampler{.object = Object(ObjectKind::kSampler)};
  const GLuint name = sampler.object.name();
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, minFilter(desc.filter, desc.mipFilter));
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER,
                      desc.filter == gpu::Filter::kNearest ? GL_NEAREST : GL_LINEAR);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, addressMode(desc.addressU));
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, addressMode(desc.addressV));
  if (desc.maxAnisotropy > 1 && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
    float most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    glSamplerParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(desc.maxAnisotropy, most));
  }
  sampler.object.label(desc.label);
  return samplers.add(std::move(sampler));
}

void Resources::destroy(gpu::Buffer buffer) {
  const BufferResource removed = buffers.remove(buffer);
  use_.deviceBytes -= removed.size;
  --use_.allocations;
  tracker.remove(buffer);
}

void Resources::destroy(gpu::Texture texture) {
  const TextureResource removed = textures.remove(texture);
  if (!removed.foreign) {
    use_.deviceBytes -= bytesOf(removed.desc);
    --use_.allocations;
  }
  tracker.remove(texture);
  std::erase_if(framebuffers_, [&](const auto& entry) {
    return std::any_of(entry.first.begin(), entry.first.end(),
                       [&](const Attachment& one) { return one.texture == removed.object.name(); });
  });
}

uint32_t Resources::viewName(const gpu::TextureView& view, bool arrayed) {
  TextureResource& texture = textures.get(view.texture);
  const gpu::TextureDesc& desc = texture.desc;
  gpu::TextureView range = view;
  range.texture = {};
  if (range.mipCount == 0) range.mipCount = desc.mips - range.mip;
  if (range.layerCount == 0) range.layerCount = desc.layers - range.layer;
  const bool whole = range.mipCount == desc.mips && range.layerCount == desc.layers;
  if (whole && arrayed == (desc.layers > 1)) return texture.object.name();
  for (const CachedView& cached : texture.views) {
    const gpu::TextureView& has = cached.range;
    if (has.mip == range.mip && has.mipCount == range.mipCount && has.layer == range.layer &&
        has.layerCount == range.layerCount && cached.arrayed == arrayed) {
      return cached.object.name();
    }
  }
  CachedView made{.range = range, .arrayed = arrayed, .object = Object::textureView()};
  glTextureView(made.object.name(), targetOf(arrayed), texture.object.name(),
                glFormat(desc.format).internalFormat, range.mip, range.mipCount, range.layer,
                range.layerCount);
  return texture.views.emplace_back(std::move(made)).object.name();
}

uint32_t Resources::framebuffer(const FramebufferKey& key) {
  const auto found = framebuffers_.find(key);
  if (found != framebuffers_.end()) return found->second.name();
  Object object(ObjectKind::kFramebuffer);
  const GLuint name = object.name();
  GLenum drawBuffers[gpu::kMaxColorTargets] = {};
  for (uint32_t i = 0; i < gpu::kMaxColorTargets; ++i) {
    if (key[i].texture == 0) continue;
    drawBuffers[i] = GL_COLOR_ATTACHMENT0 + i;
    attach(name, drawBuffers[i], key[i], isArray(key[i].texture));
  }
  const Attachment& depth = key[gpu::kMaxColorTargets];
  if (depth.texture != 0) attach(name, GL_DEPTH_ATTACHMENT, depth, isArray(depth.texture));
  glNamedFramebufferDrawBuffers(name, gpu::kMaxColorTargets, drawBuffers);
  const GLenum status = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(ErrorId::kPipelineTargets,
                "OpenGL refuses this combination of render targets (status {:#x})", status);
  }
  framebuffers_.emplace(key, std::move(object));
  return name;
}

// OpenGL orders all accesses by itself except two (section 7.13 of its specification): accesses
// after a shader's writes, and a shader's writes after reads of any kind.
uint32_t Resources::barrierBits(const gpu::Transition& transition) const {
  const bool texture = static_cast<bool>(transition.texture);
  if (has(transition.before, Access::kStorageWrite)) {
    return texture ? textureBits(textures.get(transition.texture).desc.usage)
                   : bufferBits(buffers.get(transition.buffer).usage);
  }
  if (transition.before != Access::kNone && has(transition.after, Access::kStorageWrite)) {
    return texture ? GL_SHADER_IMAGE_ACCESS_BARRIER_BIT : GL_SHADER_STORAGE_BARRIER_BIT;
  }
  return 0;
}

void Resources::barriers() {
  uint32_t bits = 0;
  for (const gpu::Transition& transition : tracker.flush()) bits |= barrierBits(transition);
  if (bits != 0) glMemoryBarrier(bits);
}

}  // namespace grisaille::opengl
