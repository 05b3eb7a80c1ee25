// SPDX-License-Identifier: MIT
// The oracle of sspm: computes the definition of effects/sspm/README.md in double precision, pixel
// by pixel.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

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

// A shot as it is composited.
struct PaintLayer {
  Shot shot;
  double times = 1;   // number of shots with this ray and range, of which it is the newest
  uint32_t seed = 0;  // of its splat
};

// The layers of a list of shots, newest first. `limited`: only of the newest `shotLimit` shots.
std::vector<PaintLayer> layersOf(std::span<const Shot> shots, const PaintSettings& settings,
                                 bool limited);

// `pixelSize`: height of a pixel at the view depth, metres. Without `sight`, the mode is
// `per_shot`.
PaintPixel paintOf(const glm::dvec3& world, double viewDepth, double pixelSize,
                   std::span<const PaintLayer> layers, const PaintSettings& settings,
                   const std::optional<Sight>& sight = std::nullopt);

}  // namespace grisaille::lab::oracle
