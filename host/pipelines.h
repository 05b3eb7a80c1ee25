// SPDX-License-Identifier: MIT
// Compute pipelines that the effects of a device share.
#pragma once

#include <string>
#include <vector>

#include "core/effect/values.h"
#include "core/gpu/forwarding_maker.h"
#include "core/gpu/host_device.h"
#include "core/objects/object.h"

namespace grisaille::host {

// The maker of the effects' resources. Equal compute pipelines are one, as long as anybody uses it.
class Pipelines final : public gpu::ForwardingMaker {
 public:
  // `device` must outlive this.
  explicit Pipelines(gpu::HostDevice& device) : ForwardingMaker(device) {}

  gpu::ComputePipeline createComputePipeline(const gpu::ComputePipelineDesc& desc) override;
  using ForwardingMaker::destroy;
  void destroy(gpu::ComputePipeline pipeline) override;

 private:
  struct Shared {
    const gpu::Shader* shader;
    std::vector<gpu::Specialization> constants;
    gpu::ComputePipeline pipeline;
    uint32_t users;
  };

  std::vector<Shared> shared_;
};

// A compute pipeline that an effect needs.
struct NeededPipeline {
  std::string label;
  const gpu::Shader* shader;
  std::vector<gpu::Specialization> constants;
};

// What decides which pipelines an effect needs, apart from its parameters.
struct Need {
  uint32_t width, height;  // pixels
  uint32_t wanted;         // outputs, by bit
  uint32_t attachments;    // GRISAILLE_READS() of those that the host gives
  bool orthographic;
};

// Records a frame on a device without a driver, and returns the pipelines that the effect created.
// Throws kEffectCreate, kEffectRecord.
std::vector<NeededPipeline> pipelinesOf(const effect::Values& values, const objects::View& objects,
                                        const Need& need);

}  // namespace grisaille::host
