// SPDX-License-Identifier: MIT
// Visibility averaged over the frames that saw the same surface. The camera may move, and the
// picture change its size and resolution: what was seen is looked up where it was seen.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "grisaille/effect.hpp"

namespace grisaille::ssao {

class History {
 public:
  explicit History(plugin::Host host);

  // Values that shape the estimate. What others made is forgotten.
  using Values = std::array<double, 6>;
  void keepOnly(const Values& values);
  void forget();

  // Frames averaged since there was nothing.
  uint64_t frames() const { return frames_; }

  // Records the pass that averages `raw` (rg32f: visibility and view depth of every `scale`-th
  // pixel both ways) with at most `most` frames before, 1 ... . The result begins with the same two
  // components; it is this object's and holds until the next call.
  grisaille_texture accumulate(const plugin::Frame& frame, uint32_t scale, uint32_t most,
                               grisaille_texture raw);

 private:
  // A mean, and how it was seen.
  struct Seen {
    plugin::Texture mean;
    uint32_t width = 0, height = 0;  // texels
    uint32_t scale = 1;              // pixels a texel, both ways
    glm::dvec2 size = {};            // pixels
    grisaille_view view = {};
  };

  plugin::Host host_;
  plugin::PipelineCache accumulate_;
  plugin::Sampler clamped_;
  Seen then_, spare_;
  Values values_ = {};
  uint64_t frames_ = 0;
};

}  // namespace grisaille::ssao
