// SPDX-License-Identifier: MIT
// A baseline for one comparison: the splat step of effects/sspm/README.md, with noise that is fixed
// to the screen instead of the world.
#pragma once

#include <cstdint>

#include "core/image/image.h"

namespace grisaille::lab::claims {

struct ScreenSplats {
  double cell = 32;        // size of the noise's largest cells, pixels
  double sharpness = 0.9;  // 0 ... 1
  uint32_t seed = 0;
};

// Computes the alpha of paint from its coverage; both pictures have one channel. The noise has the
// effect's lobes and drops, on lattices of pixels: `cell` is the size of the first octave's lobes.
// A screen knows no shot's ray, so that nothing is drawn out along the way from it.
image::Image screenSplats(const image::Image& coverage, const ScreenSplats& splats);

}  // namespace grisaille::lab::claims
