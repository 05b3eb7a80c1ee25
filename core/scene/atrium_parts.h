// SPDX-License-Identifier: MIT
// The pieces that the atrium is put together from. Each stands on y = 0 about the y axis unless it
// says otherwise; lengths in metres.
#pragma once

#include <vector>

#include "core/scene/mesh_builder.h"

namespace grisaille::scene {

// Round arches in a row along x, middle at 0, between `spring` and `top` (heights).
struct Arcade {
  uint32_t bays = 1;
  double bay = 1;       // from axis to axis
  double radius = 0.4;  // of the openings
  double spring = 0;
  double top = 1;
  double thickness = 0.4;
  double overhang = 0;  // of the wall beyond the outermost axes, may be negative
};
Solid arcadeWall(const Arcade& arcade);

// The moulding of one arch about the origin, which is its middle at the spring line.
Solid archivolt(double radius, double width, double thickness);

Solid flutedColumn(double height, double radius);
Solid plainColumn(double height, double radius);
Solid baluster(double height);
Solid vase(double height);
Solid pot(double radius);
Solid bench(double length);

// A cloth over a rail along x at the origin: short behind (-z), `drop` long in front.
Solid drape(double width, double drop, double railRadius);

// A cloth that hangs down from a rod along x at the origin.
Solid banner(double width, double drop);

// Leaf cards that grow out of a point and bend over.
Solid plant(uint32_t leaves, double length, uint32_t seed);

// A bushy leaf with holes around it, for the plant's cards.
image::Image8 leafTexture();

}  // namespace grisaille::scene
