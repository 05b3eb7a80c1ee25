// SPDX-License-Identifier: MIT
// One case of the sweep: a scenery, a camera, an effect and its values, and what must hold.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lab/stability/scenery.h"

namespace grisaille::lab::stability {

// What holds for every case, on every backend.
constexpr double kTolerance = 2.0 / 255;  // from the oracle, and of backends from one another
constexpr double kShareWithin = 0.999;    // of pixels
constexpr double kLeastOpen = 0.98;       // of a flat plane
constexpr double kCornerError = 0.02;     // rms, from what a corner's rays would find

using Settings = std::vector<std::pair<std::string, std::string>>;

struct Case {
  std::string group, name;  // together they name it; of a clause of the sweep, and of one value
  std::string variant;      // of the effect, as the table calls it
  Scenery scenery;
  scene::Camera camera;
  glm::uvec2 size = glm::uvec2(96, 64);
  std::string effect;
  std::string output = "ao";  // of the effect, which is compared
  Settings settings;
  std::vector<scene::Camera> before;  // frames that the effect draws first, with a history
  std::vector<Shot> shots;
  bool open = false;    // a flat plane: nothing is occluded anywhere
  bool corner = false;  // visibility is known: kCornerError holds in the middle of the picture
  bool quick = false;   // one of those that the tests run
  bool every = false;   // every output of the effect is looked at, not the compared ones alone
  // An edge, by a key of edges(): why more pixels than kShareWithin leaves may differ, and how
  // many.
  std::string edge;

  std::string title() const { return group + ": " + name + ", " + variant; }
};

// Where the method itself has a step, so that no arithmetic can keep both sides of it together.
struct Edge {
  const char* key;
  double share;  // of pixels that may differ by more than kTolerance, from the oracle or each other
  const char* why;
};
const std::vector<Edge>& edges();

// Before a plane y = 0 through the world's origin, at `degrees` to it and a distance in metres,
// slightly turned, so that no axis of the picture is the plane's.
scene::Camera planeCamera(double degrees, double distance);

// The cases of the sweep, each group's after one another, and so many combinations drawn at random.
std::vector<Case> sweepCases(uint32_t combinations, uint32_t seed);

// All that a case's results depend on, as text.
std::string keyOf(const Case& one);

}  // namespace grisaille::lab::stability
