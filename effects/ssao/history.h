// SPDX-License-Identifier: MIT
// Temporal accumulation: visibility averaged over the frames that saw the same surface. Camera and
// surfaces may move, and the picture may change its size and resolution: the shader reprojects
// surfaces into the previous frame. Near surfaces that move, the history stays close to the frame's
// own visibility.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "grisaille/effect.hpp"

namespace grisaille::ssao {

class History {
 public:
  explicit History(plugin::Host host);

  // Values of the parameters that change the estimate, and the kind of the camera. keepOnly()
  // forgets the history if they differ from those of the previous call.
  using Values = std::array<double, 8>;
  void keepOnly(const Values& values);
  void forget();

  // Number of frames accumulated since the history was empty.
  uint64_t frames() const { return frames_; }

  // Records the passes that average `denoised` with the history. Throws plugin::Failure.
  // scale: pixels per texel of `denoised`, in both directions.
  // most: largest number of earlier frames in the mean, at least 1.
  // denoised: rg32f, visibility and view depth.
  // Returns an rgba32f texture that starts with the same two components. This object owns it; it is
  // valid until the next call.
  grisaille_texture accumulate(const plugin::Frame& frame, uint32_t scale, uint32_t most,
                               grisaille_texture denoised);

 private:
  // Accumulated visibility, and the view that it belongs to.
  struct Seen {
    plugin::Texture mean;
    uint32_t width = 0, height = 0;  // texels
    uint32_t scale = 1;              // pixels per texel, both ways
    glm::dvec2 size = {};            // pixels
    grisaille_view view = {};
  };

  // The tiles that moving surfaces may change: see shaders/ssao/spread.comp.
  grisaille_texture reachOf(const plugin::Frame& frame, grisaille_texture motion);

  plugin::Host host_;
  plugin::PipelineCache accumulate_, reach_, spread_;
  plugin::Sampler clamped_;
  Seen then_, spare_;
  Values values_ = {};
  uint64_t frames_ = 0;
};

}  // namespace grisaille::ssao
