// SPDX-License-Identifier: MIT
// A shot's splat on the host: its seed and its noise, and step 4 of the definition, as
// shaders/sspm/splat.glsl computes them for a surface so close that no octave fades.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "shot.h"

namespace grisaille::sspm {

constexpr uint32_t kOctaves = 2;

// The seed of a shot's splat.
// noiseSeed: the parameter.
uint32_t splatSeed(const Shot& shot, uint32_t noiseSeed);

struct Splat {
  double scale = 0;     // splat_scale, metres
  float halfWidth = 0;  // of the smooth step, in strength: half of 1 - splat_sharpness
  uint32_t seed = 0;    // noise_seed

  // The noise of a shot's splat, 0 to 0.9.
  // of: splatSeed(). across: offset from the shot's ray, along the axes of its ShotFrame, metres.
  // middle: distance of the rim's middle from the ray, metres.
  float noiseAt(uint32_t of, const glm::dvec2& across, double middle) const;
  // Alpha of paint of this strength.
  float alphaOf(float strength, float noise) const;
};

}  // namespace grisaille::sspm
