// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "core/scene/scene.h"

namespace grisaille::trace {

// The alpha of a masked material, sampled like mip 0 with a linear filter on the GPU.
class AlphaMask {
 public:
  // texture: the base colour texture; null: none
  // alpha: its alpha; null if there is no texture
  AlphaMask(const scene::Material& material, const scene::Texture* texture,
            std::shared_ptr<const image::Alpha8> alpha);

  // Returns true if the alpha is below the material's cutoff. `vertexAlpha`: of the vertex colour.
  bool isHole(const glm::vec2& texCoord, float vertexAlpha) const;

 private:
  float texel(int64_t x, int64_t y) const;

  std::shared_ptr<const image::Alpha8> alpha_;
  scene::Wrap wrapU_ = scene::Wrap::kRepeat;
  scene::Wrap wrapV_ = scene::Wrap::kRepeat;
  float factor_ = 1;
  float cutoff_ = 0.5f;
};

}  // namespace grisaille::trace
