// SPDX-License-Identifier: MIT
// A baseline for one comparison alone: the splat step of effects/sspm/README.md with a noise that
// is tied to the screen instead of the world.
#pragma once

#include <cstdint>

#include "core/image/image.h"

namespace grisaille::lab::claims {

struct ScreenSplats {
  double cell = 32;        // of the noise's largest cells, pixels
  double sharpness = 0.9;  // 0 ... 1
  uint32_t seed = 0;
};

// The alpha of paint of this coverage, one channel each. The noise is the effect's in all but where
// it lives: three octaves of value noise on lattices of `cell`, a half and a quarter of it, weights
// 1, 1/2, 1/4, hashed from whole numbers; octaves under four pixels fade into their mean.
image::Image screenSplats(const image::Image& coverage, const ScreenSplats& splats);

}  // namespace grisaille::lab::claims
