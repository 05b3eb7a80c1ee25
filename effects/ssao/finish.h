// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "parameters.h"

namespace grisaille::ssao {

// Argument `finish` of finished() in shaders/ssao/finish.glsl: intensity, power, albedo or 0, 0.
inline glm::vec4 finishOf(const plugin::Frame& frame) {
  const bool grey = frame.value<Bounce>(kBounce) == Bounce::kAlbedo;
  return {frame.value<float>(kIntensity), frame.value<float>(kPower),
          grey ? frame.value<float>(kAlbedo) : 0.0f, 0.0f};
}

}  // namespace grisaille::ssao
