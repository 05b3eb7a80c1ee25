// SPDX-License-Identifier: MIT
// Measures the bias that the classic estimator needs for a plane to stay open while the camera
// moves, and the plane's flicker. It compares the effect with the method of the literature, which
// has a constant bias and no other tolerance.
//
// The true visibility of a plane is 1 in every frame: every change between frames is flicker.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lab/stability/runner.h"

namespace grisaille::lab::stability {

// kDolly: 0.2 % of the distance per frame; kJitter: up to half a pixel; kTurn: 3.7 pixels per
// frame.
enum class Movement { kDolly, kJitter, kTurn };
inline constexpr std::array kMovements = {Movement::kDolly, Movement::kJitter, Movement::kTurn};
const char* nameOf(Movement movement);

// The effect's limits at a bias of 0: kLeastOpen, and this rms change from frame to frame.
constexpr double kMostFlicker = 0.5 / 255;

// The effect at one bias on one backend.
struct Steadiness {
  std::string backend;
  double leastOpen = 1;           // least visibility over the measured pixels of all frames
  std::array<double, 3> flicker;  // rms, one for each of kMovements
};

// One plane, with a radius of 0.5 m, in the middle 48x32 pixels of a picture 720 pixels high.
struct MovementRow {
  double degrees = 0;   // between the plane and the view
  double distance = 0;  // metres
  // The method with a constant bias only, in double precision on the shader's input: the smallest
  // bias that is safe in all frames, in metres, and the largest flicker at a bias of 1 cm.
  double safeBias = 0, flickerAlone = 0;
  std::vector<Steadiness> now;  // the effect at a bias of 0, one per backend
};

// The limits that the row exceeds, one line each.
std::vector<std::string> faultsOf(const MovementRow& row);

// Rows with the tilts and distances of the table; `quick`: only some of them.
std::vector<MovementRow> movementRows(bool quick);

// Measures a row. Throws what Runner::see() throws.
void measureMovement(Runner& runner, MovementRow& row);

}  // namespace grisaille::lab::stability
