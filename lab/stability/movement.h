// SPDX-License-Identifier: MIT
// How large the classic estimator's bias must be for a plane to stay open while the camera moves,
// and what flickers there: as the effect is, and with a bias alone, as the method is described in
// the literature.
//
// A plane's visibility is 1 in every frame: all that changes from frame to frame is flicker.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lab/stability/runner.h"

namespace grisaille::lab::stability {

// A slow dolly: 0.2 % of the distance a frame; a jitter of up to half a pixel; a turn of 3.7 pixels
// a frame.
enum class Movement { kDolly, kJitter, kTurn };
inline constexpr std::array kMovements = {Movement::kDolly, Movement::kJitter, Movement::kTurn};
const char* nameOf(Movement movement);

// What holds of the effect at a bias of 0: kLeastOpen, and so much of an rms from frame to frame.
constexpr double kMostFlicker = 0.5 / 255;

// The effect at one bias on one backend.
struct Steadiness {
  std::string backend;
  double leastOpen = 1;           // visibility, of those pixels of all frames
  std::array<double, 3> flicker;  // rms, one of each of kMovements
};

// One plane, 0.5 m of radius, in the middle 48x32 pixels of a picture 720 high.
struct MovementRow {
  double degrees = 0;   // between the plane and the view
  double distance = 0;  // metres
  // With a bias alone, in double precision on what the shader reads: metres that all frames need,
  // and the largest flicker of the movements at a bias of 1 cm.
  double safeBias = 0, flickerAlone = 0;
  std::vector<Steadiness> now;  // at a bias of 0, one a backend
};

// What breaks a limit, one line each.
std::vector<std::string> faultsOf(const MovementRow& row);

// The tilts and distances of the table; `quick`: a part of them.
std::vector<MovementRow> movementRows(bool quick);

// Fills a row in. Throws as Runner::see() does.
void measureMovement(Runner& runner, MovementRow& row);

}  // namespace grisaille::lab::stability
