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

// Computes the alpha of paint from its coverage; both pictures have one channel. Apart from its
// coordinates the noise equals the effect's: three octaves of value noise on lattices of `cell`,
// 1/2 `cell` and 1/4 `cell`, weights 1, 1/2, 1/4, hashed from integers. Octaves with cells under
// four pixels fade into their mean.
image::Image screenSplats(const image::Image& coverage, const ScreenSplats& splats);

}  // namespace grisaille::lab::claims
