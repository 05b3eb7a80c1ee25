// SPDX-License-Identifier: MIT
// Which colour holds how much of what the picture shows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/effect/registry.h"
#include "core/image/image.h"
#include "core/scene/camera.h"
#include "grisaille/effect.h"

namespace grisaille::app {

// The outputs that tell of an effect's paint, by their whole names.
struct Painter {
  std::string effect, paint, owner;
};

// The first effect that has both; none: there is none.
std::optional<Painter> findPainter(std::span<const effect::Effect* const> effects);

struct ColorShare {
  std::string color;  // "#rrggbb", sRGB; "none": unpainted
  double share = 0;   // of the visible surface's area, 0 ... 1
};

// The greatest share first, "none" last. Of one size: who owns each pixel (1 + number of the shot,
// 0: nobody), the paint's alpha in the fourth channel, view depth in metres (0: sky, which is no
// surface), world normals. A pixel counts as the area of surface that it shows, where the surface
// is seen at more than 84 degrees from its normal as if at 84: a sliver does not decide a game.
std::vector<ColorShare> colorShares(const image::Image& owner, const image::Image& paint,
                                    const image::Image& depth, const image::Image& normal,
                                    const scene::Camera& camera,
                                    std::span<const grisaille_shot> shots);

// With the header color,share.
std::string coverageCsv(std::span<const ColorShare> shares);

}  // namespace grisaille::app
