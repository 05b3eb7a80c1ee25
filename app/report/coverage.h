// SPDX-License-Identifier: MIT
// Measures how much of the visible surface the objects of each colour cover.
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

// An effect's overlay and owner outputs, by their full names ("EFFECT.OUTPUT"), and the field that
// holds an object's colour.
struct Owned {
  std::string effect, overlay, owner;
  const grisaille_field_desc* colour = nullptr;
};

// The first effect with an overlay, an owner output and a colour field; none: no effect has all.
std::optional<Owned> findOwned(std::span<const effect::Effect* const> effects);

struct ColorShare {
  std::string color;  // "#rrggbb", sRGB; "none": surface without an object
  double share = 0;   // of the visible surface's area, 0 ... 1
};

// Returns the largest share first, "none" last. Pictures, all of one size:
//
//   owner    1 + index of the object at the pixel; 0: no object
//   overlay  alpha in the fourth channel
//   depth    view depth, metres; 0: sky, which does not count as surface
//   normal   world space
//
// A pixel weighs as much as the surface area that it shows. Angles of view over 84 degrees from the
// normal count as 84 degrees, so that thin slivers do not dominate.
std::vector<ColorShare> colorShares(const image::Image& owner, const image::Image& overlay,
                                    const image::Image& depth, const image::Image& normal,
                                    const scene::Camera& camera, const objects::View& objects,
                                    const objects::Field& colour);

// CSV with the header "color,share".
std::string coverageCsv(std::span<const ColorShare> shares);

}  // namespace grisaille::app
