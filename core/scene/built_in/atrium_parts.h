// SPDX-License-Identifier: MIT
// The parts of the built-in atrium. Unless stated otherwise, a part stands on y = 0 and is centred
// on the y axis. Lengths are in metres.
#pragma once

#include <vector>

#include "core/scene/mesh_builder.h"

namespace grisaille::scene {

// A row of round arches along x, centred at 0, between the heights `spring` and `top`.
struct Arcade {
  uint32_t bays = 1;
  double bay = 1;       // length of a bay, from column axis to column axis
  double radius = 0.4;  // of the openings
  double spring = 0;
  double top = 1;
  double thickness = 0.4;
  double overhang = 0;  // length of wall beyond the outermost axes; may be negative
};
Solid arcadeWall(const Arcade& arcade);

// The moulding of one arch. The origin is the centre of the arch at the spring line.
Solid archivolt(double radius, double width, double thickness);

Solid flutedColumn(double height, double radius);
Solid plainColumn(double height, double radius);
Solid baluster(double height);
Solid vase(double height);
Solid pot(double radius);
Solid bench(double length);

// A cloth over a rail that runs along x at the origin. The cloth hangs `drop` metres in front of
// the rail and a short way behind it (-z).
Solid drape(double width, double drop, double railRadius);

// A cloth that hangs down from a rod along x at the origin.
Solid banner(double width, double drop);

// Leaf cards that grow from one point and bend over.
Solid plant(uint32_t leaves, double length, uint32_t seed);

// The texture of the plant's leaf cards: a compound leaf; alpha 0 around it.
image::Image8 leafTexture();

}  // namespace grisaille::scene
