// SPDX-License-Identifier: MIT
// The estimator `classic`: sample points in a hemisphere or sphere. Two passes, occlusion and blur.
#pragma once

#include <optional>

#include "grisaille/effect.hpp"

namespace grisaille::ssao {

class Classic {
 public:
  explicit Classic(plugin::Host host);

  // Attachments that record() reads with these values: bits of GRISAILLE_READS.
  static uint32_t reads(plugin::Values values) noexcept;
  // Records both passes. `ao`: output, r16f, of the picture's size. Throws plugin::Failure.
  void record(const plugin::Frame& frame, grisaille_texture ao);

 private:
  void occlude(const plugin::Frame& frame, grisaille_texture target, bool blurred);
  void blur(const plugin::Frame& frame, grisaille_texture raw, grisaille_texture ao, uint32_t size);

  plugin::Host host_;
  plugin::PipelineCache hemisphere_, sphere_, blur_;
  plugin::Sampler clamped_, repeated_;
  plugin::Texture noise_;
  std::optional<uint32_t> noiseSeed_;  // seed of the rotations in noise_; empty: none uploaded
};

}  // namespace grisaille::ssao
