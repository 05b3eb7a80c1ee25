// SPDX-License-Identifier: MIT
// Composes the picture: the effects' layers over the surfaces, and the background elsewhere.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "core/gpu/device.h"

namespace grisaille::frame {

// One layer of the composition: `overlay` is composited over the surface, then `visibility`
// multiplies it, per channel if tinted. Both may be null.
struct Layer {
  gpu::Texture overlay, visibility;
  bool tinted = false;
};

struct Composition {
  uint32_t width = 0, height = 0;       // of the target, pixels
  gpu::Texture surface = {};            // colour of the surfaces; null: white
  gpu::Texture clipDepth = {};          // shows where the background is; null: nowhere
  uint32_t guard = 0;                   // pixels of clipDepth beyond each side of the picture
  glm::vec4 background = glm::vec4(0);  // linear light, straight alpha
  std::span<const Layer> layers;        // at least one, bottom first
  gpu::Texture target;                  // kRgba16Float
};

class Compositor {
 public:
  // The device must outlive this.
  explicit Compositor(gpu::Device& device) : device_(device) {}
  ~Compositor();
  Compositor(const Compositor&) = delete;
  Compositor& operator=(const Compositor&) = delete;

  // Records one dispatch per layer, inside a pass. Creates the pipelines at the first call.
  void record(gpu::Commands& commands, const Composition& composition);

 private:
  void create(gpu::Commands& commands);

  gpu::Device& device_;
  gpu::ComputePipeline plain_, tinted_;
  gpu::Sampler nearest_;
  gpu::Texture white_, clear_;
};

}  // namespace grisaille::frame
