// SPDX-License-Identifier: MIT
// The OpenGL objects behind the handles, and the objects derived from them: texture views and
// framebuffers.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <vector>

#include "backends/opengl/objects.h"
#include "core/gpu/handle_pool.h"
#include "core/gpu/host_device.h"
#include "core/gpu/state_tracker.h"
#include "core/gpu/types.h"

namespace grisaille::opengl {

struct BufferResource {
  Object object;
  uint64_t size = 0;
  gpu::BufferUsage usage = gpu::BufferUsage::kNone;
};

struct CachedView {
  gpu::TextureView range;  // its texture is not set
  bool arrayed = false;
  Object object;
};

struct TextureResource {
  Object object;
  gpu::TextureDesc desc;          // its label is not kept
  std::vector<CachedView> views;  // made when first bound; of a foreign texture, with it
  bool foreign = false;           // another program's texture, or a view of one
};

struct SamplerResource {
  Object object;
};

struct ComputePipelineResource {
  Object program;
  const gpu::Shader* shader = nullptr;
};

struct GraphicsPipelineResource {
  Object program;
  Object vertexArray;
  const gpu::Shader* vertex = nullptr;
  const gpu::Shader* fragment = nullptr;
  std::vector<uint32_t> strides;
  gpu::Blend blend = gpu::Blend::kNone;
};

// One attachment; texture name 0 stands for none.
struct Attachment {
  uint32_t texture = 0;
  uint32_t mip = 0;
  uint32_t layer = 0;
  auto operator<=>(const Attachment&) const = default;
};

// The colour targets, then the depth target.
using FramebufferKey = std::array<Attachment, gpu::kMaxColorTargets + 1>;

// Runs `allocate`, which gives storage to an object. Throws kOutOfDeviceMemory if OpenGL refuses.
void allocateStorage(const char* kind, std::string_view label, uint64_t bytes,
                     const std::function<void()>& allocate);

uint64_t bytesOf(const gpu::TextureDesc& desc);

class Resources {
 public:
  // All throw kOutOfDeviceMemory and kTooManyResources; kTextureSize for a texture over the limit.
  gpu::Buffer createBuffer(const gpu::BufferDesc& desc);
  gpu::Texture createTexture(const gpu::TextureDesc& desc);
  gpu::Sampler createSampler(const gpu::SamplerDesc& desc);

  void destroy(gpu::Buffer buffer);
  void destroy(gpu::Texture texture);

  // Bytes that OpenGL is asked for at present. Drivers add some, and tell nobody how much.
  const gpu::MemoryUse& use() const { return use_; }

  // Creates a buffer that stays mapped for writing. Barriers need not cover it.
  gpu::Buffer createMapped(uint64_t size, std::byte*& memory);

  // The name to bind to a shader's texture slot: the texture itself if the view covers all of it,
  // else a cached view. `arrayed`: the slot expects an array, which may have one layer.
  uint32_t viewName(const gpu::TextureView& view, bool arrayed);

  uint32_t framebuffer(const FramebufferKey& key);

  // Issues the memory barriers for the tracker's transitions.
  void barriers();

  gpu::HandlePool<gpu::Buffer, BufferResource> buffers{"buffer"};
  gpu::HandlePool<gpu::Texture, TextureResource> textures{"texture"};
  gpu::HandlePool<gpu::Sampler, SamplerResource> samplers{"sampler"};
  gpu::HandlePool<gpu::ComputePipeline, ComputePipelineResource> computePipelines{
      "compute pipeline"};
  gpu::HandlePool<gpu::GraphicsPipeline, GraphicsPipelineResource> graphicsPipelines{
      "graphics pipeline"};
  gpu::StateTracker tracker;

 private:
  uint32_t barrierBits(const gpu::Transition& transition) const;

  std::map<FramebufferKey, Object> framebuffers_;
  gpu::MemoryUse use_;
};

}  // namespace grisaille::opengl
