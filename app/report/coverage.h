// SPDX-License-Identifier: MIT
// Which colour holds how much of what the picture shows, where an effect's objects have colours.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/effect/registry.h"
#include "core/image/image.h"
#include "core/objects/object.h"
#include "core/scene/camera.h"
#include "grisaille/effect.h"

namespace grisaille::app {

// The outputs that tell which of an effect's objects lies where, by their whole names, and the
// field that holds an object's colour.
struct Owned {
  std::string effect, overlay, owner;
  const grisaille_field_desc* colour = nullptr;
};

// The first effect that has all of them; none: there is none.
std::optional<Owned> findOwned(std::span<const effect::Effect* const> effects);

struct ColorShare {
  std::string color;  // "#rrggbb", sRGB; "none": no object's
  double share = 0;   // of the visible surface's area, 0 ... 1
};

// The greatest share first, "none" last. Of one size: whose each pixel is (1 + index of the object,
// 0: nobody's), the overlay's alpha in the fourth channel, view depth in metres (0: sky, which is
// no surface), world normals. A pixel counts as the area of surface that it shows, where the
// surface is seen at more than 84 degrees from its normal as if at 84: a sliver does not decide a
// game.
std::vector<ColorShare> colorShares(const image::Image& owner, const image::Image& overlay,
                                    const image::Image& depth, const image::Image& normal,
                                    const scene::Camera& camera, const objects::View& objects,
                                    const objects::Field& colour);

// With the header color,share.
std::string coverageCsv(std::span<const ColorShare> shares);

}  // namespace grisaille::app
