// SPDX-License-Identifier: MIT
// Furniture and household things. Unless stated otherwise, a part stands on y = 0 and is centred on
// the y axis. Lengths are in metres.
#pragma once

#include <cstdint>

#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {

// size: length along x, height, depth
Solid diningTable(const glm::dvec3& size);

// A chair with a slatted back at -z.
Solid chair();

// A case of shelves with its back at -z. size: width along x, height, depth; boards: number of
// shelves, with bottom and top
Solid shelf(const glm::dvec3& size, uint32_t boards);

// A book that stands; its spine faces +z at z = 0. size: thickness along x, height, depth
Solid book(const glm::dvec3& size);

Solid bowl(double radius, double height);
Solid fruit(double radius, uint32_t seed);
Solid cup();
Solid saucer(double radius);
Solid bottle(double height);
Solid candlestick(double height);

// An open box with walls of `wall` metres. size: along x, y, z
Solid crate(const glm::dvec3& size, double wall);

// A radiator along x whose back is at -z.
Solid radiator(double length, double height);

// A lamp that hangs from the origin: its cord and its shade.
struct HangingLamp {
  Solid cord, shade;
};
HangingLamp hangingLamp(double length, double radius);

// A curtain that hangs from y = 0 along x, with folds; a sheet.
Solid curtain(double width, double drop, uint32_t folds);

// A cloth of `width` along z over a table's edges: it lies from x = -half to +half at y = 0 and
// hangs down by `drop` at both ends; a sheet.
Solid runner(double half, double width, double drop);

// A cloth that lies on the floor, with waves; a closed slab.
Solid rug(const glm::dvec2& size);

}  // namespace grisaille::scene
