// SPDX-License-Identifier: MIT
// The classic method: sample points in a hemisphere. Two passes, occlusion and blur.
#pragma once

#include <optional>

#include "grisaille/effect.hpp"

namespace grisaille::ssao {

class Classic {
 public:
  explicit Classic(plugin::Host host);

  static uint32_t reads(plugin::Values values) noexcept;
  // `ao`: r16f, of the picture's size.
  void record(const plugin::Frame& frame, grisaille_texture ao);

 private:
  void occlude(const plugin::Frame& frame, grisaille_texture target, bool blurred);
  void blur(const plugin::Frame& frame, grisaille_texture raw, grisaille_texture ao, uint32_t size);

  plugin::Host host_;
  plugin::PipelineCache hemisphere_, sphere_, blur_;
  plugin::Sampler clamped_, repeated_;
  plugin::Texture noise_;
  std::optional<uint32_t> noiseSeed_;  // which seed noise_ holds
};

}  // namespace grisaille::ssao
