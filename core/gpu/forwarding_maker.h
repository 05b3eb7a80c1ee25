// SPDX-License-Identifier: MIT
// Makes resources with another maker: the base of makers that change or note some of the calls.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::gpu {

class ForwardingMaker : public Maker {
 public:
  // `to` must outlive this.
  explicit ForwardingMaker(Maker& to) : to_(to) {}

  const DeviceInfo& info() const override { return to_.info(); }
  Buffer createBuffer(const BufferDesc& desc) override { return to_.createBuffer(desc); }
  Texture createTexture(const TextureDesc& desc) override { return to_.createTexture(desc); }
  Sampler createSampler(const SamplerDesc& desc) override { return to_.createSampler(desc); }
  ComputePipeline createComputePipeline(const ComputePipelineDesc& desc) override {
    return to_.createComputePipeline(desc);
  }
  GraphicsPipeline createGraphicsPipeline(const GraphicsPipelineDesc& desc) override {
    return to_.createGraphicsPipeline(desc);
  }
  void destroy(Buffer buffer) override { to_.destroy(buffer); }
  void destroy(Texture texture) override { to_.destroy(texture); }
  void destroy(Sampler sampler) override { to_.destroy(sampler); }
  void destroy(ComputePipeline pipeline) override { to_.destroy(pipeline); }
  void destroy(GraphicsPipeline pipeline) override { to_.destroy(pipeline); }

 private:
  Maker& to_;
};

}  // namespace grisaille::gpu
