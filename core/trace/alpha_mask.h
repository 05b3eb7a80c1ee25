// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/scene/scene.h"

namespace grisaille::trace {

// The alpha of a masked material, sampled like mip 0 with a linear filter on the GPU.
class AlphaMask {
 public:
  // Throws kSceneImage if the texture does not decode.
  AlphaMask(const scene::Scene& scene, const scene::Material& material);

  // Returns true if the alpha is below the material's cutoff.
  bool isHole(const glm::vec2& texCoord) const;

 private:
  float texel(int64_t x, int64_t y) const;

  uint32_t width_ = 1;
  uint32_t height_ = 1;
  std::vector<uint8_t> alpha_ = {255};
  scene::Wrap wrapU_ = scene::Wrap::kRepeat;
  scene::Wrap wrapV_ = scene::Wrap::kRepeat;
  float factor_ = 1;
  float cutoff_ = 0.5f;
};

}  // namespace grisaille::trace
