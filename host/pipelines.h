// SPDX-License-Identifier: MIT
// Compute pipelines that the effects of a device share.
#pragma once

#include <string>
#include <vector>

#include "core/effect/values.h"
#include "core/gpu/forwarding_maker.h"
#include "core/gpu/host_device.h"
#include "core/objects/object.h"
#include "host/log.h"

namespace grisaille::host {

// The maker of the effects' resources. Equal compute pipelines are one, as long as anybody uses it.
class Pipelines final : public gpu::ForwardingMaker {
 public:
  // Both must outlive this.
  Pipelines(gpu::HostDevice& device, const Log& log) : ForwardingMaker(device), log_(log) {}

  // The effect that records, for the log; null: none.
  void setRecording(const char* effect) { recording_ = effect; }

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

  const Log& log_;
  const char* recording_ = nullptr;
  std::vector<Shared> shared_;
};

// A compute pipeline that an effect needs.
struct NeededPipeline {
  std::string label;
  const gpu::Shader* shader;
  std::vector<gpu::Specialization> constants;
};

// What decides what an effect needs, apart from its parameters.
struct Need {
  uint32_t width, height;  // pixels
  uint32_t wanted;         // outputs, by bit
  uint32_t inputs;         // GRISAILLE_READS() of the optional textures that the host gives
  bool orthographic;
  bool copies;      // the outputs are copies of what the effect writes
  uint32_t layers;  // at least 1
};

// The texture of an output.
gpu::TextureDesc outputDesc(const grisaille_output_desc& output, uint32_t width, uint32_t height,
                            uint32_t layers);

// What an effect needs.
struct Needed {
  std::vector<NeededPipeline> pipelines;
  gpu::MemoryUse memory;  // hostBytes: of one frame
};

// Records frames on a device without a driver. `device` tells the sizes of resources. Throws
// kEffectCreate, kEffectRecord.
Needed neededOf(const gpu::HostDevice& device, const effect::Values& values,
                const objects::View& objects, const Need& need);

}  // namespace grisaille::host
