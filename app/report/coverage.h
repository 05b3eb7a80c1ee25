// SPDX-License-Identifier: MIT
// Measures how much of the scene's surface the objects of each colour cover.
#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/services/scene_services.h"
#include "core/effect/chain.h"

namespace grisaille::app {

// An effect that tells what it draws at points, and the field that holds an object's colour.
struct Owned {
  std::string effect;
  const grisaille_field_desc* colour = nullptr;
};

// The first effect with a function draw_at() and a colour field; none: no effect has both.
std::optional<Owned> findOwned(std::span<const effect::Effect* const> effects);

struct ColorShare {
  std::string color;  // "#rrggbb", sRGB; "none": surface without an object
  double share = 0;   // of the surface's area, 0 ... 1
};

struct Coverage {
  std::vector<ColorShare> shares;  // the largest first, "none" last; they add up to 1
  size_t points = 0;               // at which the surface was sampled
  double area = 0;                 // of the surface, square metres
};

// The share of the surfaces whose normal is at most `steepest` (radians) from +y; pi: all. Both
// sides of two-sided materials count. With 100,000 points, the standard error of a share is at most
// 0.0016.
struct CoverageSpec {
  double steepest = std::numbers::pi;
  uint32_t points = 100'000;
};

// Objects that record() has not placed, and those that are given up, cover nothing. Throws the
// errors of Chain::drawAt(), and kLeftOut in a build without rays.
Coverage coverageOf(effect::Chain& chain, const Owned& owned, SceneRays& rays,
                    const CoverageSpec& spec);

// CSV with the header "color,share".
std::string coverageCsv(std::span<const ColorShare> shares);

}  // namespace grisaille::app
