// SPDX-License-Identifier: MIT
// Houses, cars and furniture of a street. Unless stated otherwise, a part stands on y = 0 and is
// centred on the y axis. Lengths are in metres.
#pragma once

#include <cstdint>

#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {

struct HouseForm {
  double width = 9;
  double depth = 8;
  double storey = 3.1;   // height of an upper storey
  uint32_t storeys = 3;  // above the ground floor
  uint32_t windows = 3;  // side by side
  bool shop = false;     // wide openings on the ground floor
  bool balconies = false;
  bool pitched = true;  // roof
};

// A house that faces +z with its front at z = 0. It reaches below y = 0.
struct House {
  Solid walls, trim, roof, glass, metal;
  double height = 0;                // of the walls
  std::vector<double> shopWindows;  // their middles along x
  double shopWidth = 0;             // of each of them
};
House house(const HouseForm& form, uint32_t seed);

// A car along x; its front is at +x.
struct Car {
  Solid body, glass, tyres, metal;
};
Car car(double length, bool van);

// A lamp post whose arm reaches to +z.
Solid lampPost(double height);

// A bench along x whose back is at -z: its slats and its irons.
struct StreetBench {
  Solid slats, irons;
};
StreetBench streetBench(double length);

// An awning that slopes down to +z from the origin, with a scalloped edge; a sheet.
Solid awning(double width, double reach, double drop);

Solid bollard();
Solid bin();
Solid bicycleStand();

}  // namespace grisaille::scene
