// SPDX-License-Identifier: MIT
// The oracle of sspm: computes the definition of effects/sspm/README.md in double precision, pixel
// by pixel.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "core/scene/camera.h"
#include "lab/paint/shot.h"

namespace grisaille::lab::oracle {

struct PaintSettings {
  double paintRange = 0.25;
  double full = 1;  // the parameter r0, metres
  size_t shotLimit = 64;
  double edgeFade = 0.5;
  double splatScale = 0.06;
  double splatSharpness = 0.9;
  uint32_t noiseSeed = 0;
};

struct PaintPixel {
  glm::dvec4 paint = glm::dvec4(0);
  double coverage = 0;
};

// Input of the mode `surface`, in which a shot paints only surfaces that its muzzle sees.
struct Sight {
  glm::dvec3 facet;  // the pixel's facet normal, world, unit; 0: unknown, and nothing paints there
  // Whether a shot's muzzle sees the pixel. Empty: every muzzle does.
  std::function<bool(const Shot& shot)> sees = {};
};

// `pixelSize`: height of a pixel at the view depth, metres. Without `sight`, the mode is
// `per_shot`.
PaintPixel paintOf(const glm::dvec3& world, double viewDepth, double pixelSize,
                   std::span<const Shot> shots, const PaintSettings& settings,
                   const std::optional<Sight>& sight = std::nullopt);

double splatNoise(const glm::dvec3& world, double pixelSize, const PaintSettings& settings);

}  // namespace grisaille::lab::oracle
