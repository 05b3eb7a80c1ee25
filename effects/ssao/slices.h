// SPDX-License-Identifier: MIT
// The estimator `slices`: visibility by slices and a bitmask of sectors. Passes, at the effect's
// resolution: occlusion, accumulate (with `history` above 1), denoise and edges. Unless that is the
// picture's, upsample follows, which lists the blocks that it serves badly; then occlusion and
// denoiser of these.
#pragma once

#include "dispatch.h"
#include "grisaille/effect.hpp"
#include "history.h"

namespace grisaille::ssao {

class Slices {
 public:
  explicit Slices(plugin::Host host);

  // Visibility and mean open direction. `bent` with id 0: none, at no cost.
  struct Pair {
    grisaille_texture open, bent;
  };

  // Attachments that record() reads with these values: bits of GRISAILLE_READS.
  static uint32_t reads(plugin::Values values) noexcept;
  // Records all passes. `outputs`: r16f and rgba16f, of the picture's size. Throws plugin::Failure.
  void record(const plugin::Frame& frame, Pair outputs);
  // Forgets the history of earlier frames.
  void forget() { history_.forget(); }

 private:
  struct Size {
    uint32_t scale;          // pixels per texel, each way
    uint32_t width, height;  // texels
    // Of the facets that the texels sample: r32ui, see shaders/ssao/facet.glsl. Not for the list.
    grisaille_texture tangents;
  };
  // Blocks with pixels that are computed at full resolution, see shaders/ssao/upsample.glsl.
  struct Listed {
    grisaille_binding list;
    grisaille_texture blocks, bent;
  };
  // A pass of shaders/ssao/denoise.glsl.
  struct Tent {
    bool columns;    // along columns, else along rows
    uint32_t width;  // at half height, pixels; 0: one texel
    bool last;       // it writes the outputs
  };
  struct Kernels {
    explicit Kernels(plugin::Host host);
    static Kernels withBent(plugin::Host host);
    plugin::PipelineCache occlusion, denoise, denoiseLast, edges, edgesLast, upsample, listed,
        refined;
  };

  // `listed`: the blocks whose pixels to compute, at the picture's resolution; their
  // visibilities go to its `blocks`, which are target.open. nullptr: all texels.
  void occlude(const plugin::Frame& frame, plugin::PipelineCache& pipelines, Size size, Pair target,
               const Listed* listed);
  Bindings filterBindings(const plugin::Frame& frame, Size size, bool last, Pair from,
                          Pair target) const;
  void denoise(const plugin::Frame& frame, Kernels& kernels, Size size, Tent tent, Pair raw,
               Pair target);
  void alongEdges(const plugin::Frame& frame, Kernels& kernels, Size size, bool last, Pair denoised,
                  Pair target);
  void enlarge(const plugin::Frame& frame, Kernels& kernels, Size size, Pair coarse, Pair outputs);
  void upsample(const plugin::Frame& frame, Kernels& kernels, Size size, Pair coarse,
                const Listed& listed, Pair target);
  void denoiseListed(const plugin::Frame& frame, Kernels& kernels, const Listed& listed,
                     grisaille_texture rawBent, Pair target);
  grisaille_binding listFor(const plugin::Frame& frame, bool refines);
  static uint32_t listGroups(const plugin::Frame& frame);

  plugin::Host host_;
  Kernels open_, openAndBent_;
  plugin::Sampler clamped_;
  History history_;
  plugin::Buffer list_;
  uint64_t listWords_ = 0;
};

}  // namespace grisaille::ssao
