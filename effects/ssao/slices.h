// SPDX-License-Identifier: MIT
// Visibility by slices and a bitmask of sectors. Up to three passes: occlusion and denoise, at the
// resolution that is asked for, and upsample where that is not the picture's.
#pragma once

#include "grisaille/effect.hpp"

namespace grisaille::ssao {

class Slices {
 public:
  explicit Slices(plugin::Host host);

  static uint32_t reads() noexcept;
  void record(const plugin::Frame& frame);

 private:
  struct Size {
    uint32_t scale;  // pixels a texel, each way
    uint32_t width, height;
  };

  void occlude(const plugin::Frame& frame, Size size, grisaille_texture target);
  void denoise(const plugin::Frame& frame, Size size, plugin::PipelineCache& pipelines,
               bool columns, uint32_t blur, grisaille_texture raw, grisaille_texture target);
  void upsample(const plugin::Frame& frame, Size size, grisaille_texture coarse);

  plugin::PipelineCache occlusion_, denoise_, denoiseLast_, upsample_;
  plugin::Sampler clamped_;
};

}  // namespace grisaille::ssao
