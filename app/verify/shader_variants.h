// SPDX-License-Identifier: MIT
// Shaders that must do the same as an effect's own, but do not if those have a fault.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "core/gpu/forwarding_maker.h"

namespace grisaille::app {

enum class Variant : uint8_t {
  kPlain,
  // The threads of a workgroup take one another's places. The result changes if it depends on the
  // order of threads, as with a race in shared memory.
  kReversed,
  // A thread whose loops take very many turns leaves them and stores 0. The result changes if a
  // loop never ends; some drivers end it themselves.
  kCounted,
  // An index outside of a storage buffer, an image or a fetched texture leads to the first element,
  // or to the last one. A store outside of an image has no effect, or hits the texel that the
  // thread wrote last. The results differ if there is such an index or store.
  kFirst,
  kLast
};

// The GLSL of the variant. `glsl` is text that SPIRV-Cross wrote: the shader compiler of effects.
std::string variantOf(std::string glsl, Variant variant);

// Makes compute pipelines of a variant. For OpenGL: other backends do not read the GLSL.
class VariantMaker final : public gpu::ForwardingMaker {
 public:
  // `to` must outlive this, and this the pipelines.
  VariantMaker(gpu::Maker& to, Variant variant) : ForwardingMaker(to), variant_(variant) {}

  gpu::ComputePipeline createComputePipeline(const gpu::ComputePipelineDesc& desc) override;

 private:
  struct Own {
    std::string glsl;
    gpu::Shader shader;
  };
  const Variant variant_;
  std::deque<Own> shaders_;
};

}  // namespace grisaille::app
