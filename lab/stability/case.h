// SPDX-License-Identifier: MIT
// One case of the sweep: a scenery, a camera, an effect with its values, and the limits to check.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lab/stability/scenery.h"

namespace grisaille::lab::stability {

// The limits for every case, on every backend.
constexpr double kTolerance = 2.0 / 255;  // difference from the oracle and between backends
constexpr double kShareWithin = 0.999;    // least share of pixels within kTolerance
constexpr double kLeastOpen = 0.98;       // least visibility of a flat plane
constexpr double kCornerError = 0.02;     // rms error against cornerVisibility()

using Settings = std::vector<std::pair<std::string, std::string>>;

struct Case {
  std::string group, name;  // the varied quantity, and its value in this case
  std::string variant;      // the effect's variant, by its name in the table
  Scenery scenery;
  scene::Camera camera;
  glm::uvec2 size = glm::uvec2(96, 64);
  std::string effect;
  std::string output = "ao";  // the effect's output that is compared
  Settings settings;
  std::vector<scene::Camera> before;  // cameras of the frames that the history holds
  std::vector<Shot> shots;
  bool open = false;    // a flat plane: kLeastOpen must hold everywhere
  bool corner = false;  // a right-angled corner: kCornerError must hold in the picture's middle
  bool quick = false;   // the tests run this case
  bool every = false;   // checks the range of all outputs of the effect, not only the compared ones
  // The key of one of edges(), which allows more pixels than 1 - kShareWithin to differ; "": none.
  std::string edge;

  std::string title() const { return group + ": " + name + ", " + variant; }
};

// A known discontinuity of the method: rounding decides between its two sides, in any arithmetic.
struct Edge {
  const char* key;
  double
      share;  // share of pixels that may differ by over kTolerance, from the oracle or each other
  const char* why;
};
const std::vector<Edge>& edges();

// A camera that looks at the plane y = 0 at an angle of `degrees`, from `distance` metres. It is
// turned a little, so that no axis of the picture is parallel to the plane's axes.
scene::Camera planeCamera(double degrees, double distance);

// The cases of the sweep, sorted by group, then `combinations` random cases drawn from `seed`.
std::vector<Case> sweepCases(uint32_t combinations, uint32_t seed);

// Everything that a case's results depend on, as text.
std::string keyOf(const Case& one);

}  // namespace grisaille::lab::stability
