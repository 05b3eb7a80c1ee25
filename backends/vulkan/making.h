// SPDX-License-Identifier: MIT
// What every device of this backend makes alike, whoever submits its work.
#pragma once

#include "backends/vulkan/commands.h"
#include "backends/vulkan/pipeline_cache.h"

namespace grisaille::vulkan {

// `Interface` is a gpu::Maker.
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
  // `origin` is what a Context is made of.
  template <typename Origin>
  Making(const Origin& origin, CacheFile file)
      : context_(origin), cache_(context_, file), resources_(context_) {}

  // As Resources::retire() and releaseUpTo() count: the last work that may use what there is now,
  // and the last that has finished.
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
