// SPDX-License-Identifier: MIT
// What a shot may be. Everything that holds shots holds them as makeShot() leaves them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "grisaille/effect.h"

namespace grisaille::shots {

constexpr double kFarthestOrigin = 1e9;  // metres from the world's origin, on each axis
constexpr double kLongestRange = 1e6;    // metres

// A shot as a person or a file states it.
struct ShotValues {
  std::array<double, 3> origin{};     // world, metres
  std::array<double, 3> direction{};  // of any finite length over 0
  std::array<double, 3> color{};      // linear, each 0 ... 1
  double range = 0;                   // metres; 0: as the effect's parameter says
};

// The shot with a unit direction. A direction that is unit to within the rounding of floats is kept
// as it is, so that making a shot of a shot changes no bit of it. Throws kShotOrigin,
// kShotDirection, kShotColor or kShotRange.
grisaille_shot makeShot(const ShotValues& values);

// Throws as makeShot() does.
void check(const grisaille_shot& shot);

// All as makeShot() leaves them. Throws as it does, with the index of the shot.
std::vector<grisaille_shot> checked(std::span<const grisaille_shot> shots);

}  // namespace grisaille::shots
