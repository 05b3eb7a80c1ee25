// SPDX-License-Identifier: MIT
// The base class of both devices of this backend: creates and destroys resources. The device itself
// submits the work, or another program does.
#pragma once

#include "backends/vulkan/commands.h"
#include "backends/vulkan/pipeline_cache.h"

namespace grisaille::vulkan {

// `Interface`: gpu::Device or gpu::HostDevice, which both derive from gpu::Maker.
template <typename Interface>
class Making : public Interface {
 public:
  const gpu::DeviceInfo& info() const override { return context_.info; }

  gpu::Buffer createBuffer(const gpu::BufferDesc& desc) override { return resources_.add(desc); }
  gpu::Texture createTexture(const gpu::TextureDesc& desc) override { return resources_.add(desc); }
  gpu::Sampler createSampler(const gpu::SamplerDesc& desc) override { return resources_.add(desc); }
  gpu::ComputePipeline createComputePipeline(const gpu::ComputePipelineDesc& desc) override {
    return resources_.add(cache_.handle(), desc);
  }
  gpu::GraphicsPipeline createGraphicsPipeline(const gpu::GraphicsPipelineDesc& desc) override {
    return resources_.add(cache_.handle(), desc);
  }

  void destroy(gpu::Buffer buffer) override { retire(buffer); }
  void destroy(gpu::Texture texture) override { retire(texture); }
  void destroy(gpu::Sampler sampler) override { retire(sampler); }
  void destroy(gpu::ComputePipeline pipeline) override { retire(pipeline); }
  void destroy(gpu::GraphicsPipeline pipeline) override { retire(pipeline); }

 protected:
  // `origin`: the argument of Context's constructor, options or another program's handles.
  template <typename Origin>
  Making(const Origin& origin, CacheFile file, VkPipelineCache cache = VK_NULL_HANDLE)
      : context_(origin), cache_(context_, file, cache), resources_(context_) {}

  // Counts for Resources::retire() and releaseUpTo(): the last work that may use the existing
  // objects, and the last work that has finished.
  virtual uint64_t lastUse() const = 0;
  virtual uint64_t finished() const = 0;

  Context context_;
  PipelineCache cache_;
  Resources resources_;

 private:
  template <typename HandleType>
  void retire(HandleType handle) {
    if (!handle) return;
    resources_.retire(handle, lastUse());
    resources_.releaseUpTo(finished());
  }
};

}  // namespace grisaille::vulkan
