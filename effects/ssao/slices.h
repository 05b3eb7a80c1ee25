// SPDX-License-Identifier: MIT
// Visibility by slices and a bitmask of sectors: occlusion, accumulate where frames are averaged,
// denoise and edges, at the resolution that is asked for, then upsample where that is not the
// picture's.
#pragma once

#include "dispatch.h"
#include "grisaille/effect.hpp"
#include "history.h"

namespace grisaille::ssao {

class Slices {
 public:
  explicit Slices(plugin::Host host);

  // Visibility, and the mean open direction where `bent` is there; it costs nothing where not.
  struct Pair {
    grisaille_texture open, bent;
  };

  static uint32_t reads(plugin::Values values) noexcept;
  // `outputs`: r16f and rgba16f, of the picture's size.
  void record(const plugin::Frame& frame, Pair outputs);
  // What frames before leave for those to come.
  void forget() { history_.forget(); }

 private:
  struct Size {
    uint32_t scale;  // pixels a texel, each way
    uint32_t width, height;
  };
  struct Kernels {
    explicit Kernels(plugin::Host host);
    static Kernels withBent(plugin::Host host);
    plugin::PipelineCache occlusion, denoise, denoiseLast, edges, edgesLast, upsample;
  };

  void occlude(const plugin::Frame& frame, Kernels& kernels, Size size, Pair target);
  Bindings filterBindings(const plugin::Frame& frame, Pair from, Pair target) const;
  void denoise(const plugin::Frame& frame, plugin::PipelineCache& pipelines, Size size,
               bool columns, uint32_t blur, Pair raw, Pair target);
  void alongEdges(const plugin::Frame& frame, plugin::PipelineCache& pipelines, Size size,
                  Pair denoised, Pair target);
  void upsample(const plugin::Frame& frame, Kernels& kernels, Size size, Pair coarse, Pair target);

  Kernels open_, openAndBent_;
  plugin::Sampler clamped_;
  History history_;
};

}  // namespace grisaille::ssao
