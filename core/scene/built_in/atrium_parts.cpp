// SPDX-License-Identifier: MIT
#include "core/scene/built_in/atrium_parts.h"

#include <cmath>

#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {
namespace {

// Appends a quarter-round moulding to a lathe profile, from the last point to `to`.
void addRound(std::vector<glm::dvec2>& profile, const glm::dvec2& to, bool convexOut) {
  const glm::dvec2 from = profile.back();
  constexpr int kSteps = 2;
  for (int i = 1; i <= kSteps; ++i) {
    const double turn = 0.25 * i / kSteps;
    const double s = sinTurns(turn), c = 1 - cosTurns(turn);
    profile.emplace_back(from.x + (to.x - from.x) * (convexOut ? s : c),
                         from.y + (to.y - from.y) * (convexOut ? c : s));
  }
}

// Adds the plinth and the base of a column. Returns the height of the shaft's foot.
double addBase(Solid& solid, double radius, uint32_t segments) {
  const double r = radius, plinth = 0.45 * r;
  append(solid, box({-1.42 * r, 0, -1.42 * r}, {1.42 * r, plinth, 1.42 * r}, 0.06 * r));
  std::vector<glm::dvec2> profile{{1.2 * r, plinth - 0.05 * r}, {1.2 * r, plinth}};
  addRound(profile, {1.4 * r, plinth + 0.2 * r}, true);
  addRound(profile, {1.2 * r, plinth + 0.4 * r}, false);
  profile.emplace_back(1.14 * r, plinth + 0.42 * r);
  addRound(profile, {1.08 * r, plinth + 0.55 * r}, false);
  profile.emplace_back(1.16 * r, plinth + 0.6 * r);
  addRound(profile, {1.22 * r, plinth + 0.7 * r}, true);
  addRound(profile, {1.04 * r, plinth + 0.82 * r}, false);
  append(solid, lathe(profile, segments));
  return plinth + 0.78 * r;
}

// Adds a capital whose top is at `height`. Returns the height of its foot.
double addCapital(Solid& solid, double height, double radius, uint32_t segments) {
  const double r = radius, abacus = height - 0.4 * r, bottom = abacus - 0.75 * r;
  append(solid, box({-1.38 * r, abacus, -1.38 * r}, {1.38 * r, height, 1.38 * r}, 0.08 * r));
  std::vector<glm::dvec2> profile{{0.84 * r, bottom - 0.02 * r}, {0.98 * r, bottom}};
  addRound(profile, {1.0 * r, bottom + 0.1 * r}, true);
  profile.emplace_back(0.88 * r, bottom + 0.14 * r);
  profile.emplace_back(0.88 * r, bottom + 0.3 * r);
  profile.emplace_back(0.96 * r, bottom + 0.34 * r);
  addRound(profile, {1.3 * r, bottom + 0.66 * r}, true);
  profile.emplace_back(1.3 * r, abacus + 0.04 * r);
  append(solid, lathe(profile, segments));
  return bottom;
}

// The lathe profile of a shaft that swells and tapers, between two heights.
std::vector<glm::dvec2> shaft(double from, double to, double radius, int rings) {
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= rings; ++i) {
    const double t = static_cast<double>(i) / rings;
    profile.emplace_back(radius * (1 - 0.16 * t * t + 0.02 * sinTurns(t / 2)),
                         from + (to - from) * t);
  }
  return profile;
}

}  // namespace

Solid arcadeWall(const Arcade& arcade) {
  std::vector<Ring> rings;
  const double half = arcade.thickness / 2;
  const auto slice = [&](double x, double bottom) {
    rings.push_back(
        {{x, bottom, half}, {x, arcade.top, half}, {x, arcade.top, -half}, {x, bottom, -half}});
  };
  const double end = arcade.bays * arcade.bay / 2 + arcade.overhang;
  slice(-end, arcade.spring);
  constexpr int kSteps = 18;
  for (uint32_t i = 0; i < arcade.bays; ++i) {
    const double middle = (i + 0.5 - arcade.bays / 2.0) * arcade.bay;
    for (int k = 0; k <= kSteps; ++k) {
      const double turn = 0.5 - 0.5 * k / kSteps;
      slice(middle + arcade.radius * cosTurns(turn),
            arcade.spring + arcade.radius * sinTurns(turn));
    }
  }
  slice(end, arcade.spring);
  return loft(rings, false);
}

Solid archivolt(double radius, double width, double thickness) {
  // Cross-section of the ring: (fraction of the width, fraction of half the thickness).
  constexpr glm::dvec2 kProfile[] = {{-0.03, 0.88}, {0.3, 0.9},    {0.38, 1}, {0.8, 1},
                                     {1, 0.86},     {1, -0.86},    {0.8, -1}, {0.38, -1},
                                     {0.3, -0.9},   {-0.03, -0.88}};
  std::vector<Ring> rings;
  constexpr int kSteps = 12;
  for (int k = 0; k <= kSteps; ++k) {
    const double turn = 0.5 * k / kSteps;
    Ring& ring = rings.emplace_back();
    for (const glm::dvec2& point : kProfile) {
      const double r = radius + width * point.x;
      ring.emplace_back(r * cosTurns(turn), r * sinTurns(turn), thickness / 2 * point.y);
    }
  }
  return loft(rings, false);
}

Solid flutedColumn(double height, double radius) {
  Solid solid;
  const double from = addBase(solid, radius, 20), to = addCapital(solid, height, radius, 20);
  append(solid, lathe(shaft(from, to + 0.05 * radius, radius, 4), 48, 12, 0.1));
  return solid;
}

Solid plainColumn(double height, double radius) {
  Solid solid;
  const double from = addBase(solid, radius, 12), to = addCapital(solid, height, radius, 12);
  append(solid, lathe(shaft(from, to + 0.05 * radius, radius, 4), 16));
  return solid;
}

Solid baluster(double height) {
  constexpr glm::dvec2 kProfile[] = {{0.062, 0},    {0.062, 0.09}, {0.034, 0.15}, {0.058, 0.26},
                                     {0.066, 0.37}, {0.055, 0.5},  {0.033, 0.7},  {0.031, 0.83},
                                     {0.058, 0.91}, {0.058, 1}};
  std::vector<glm::dvec2> profile;
  for (const glm::dvec2& point : kProfile) profile.emplace_back(point.x, point.y * height);
  return lathe(profile, 9);
}

Solid vase(double height) {
  // Up the outside, over the lip and down the inside: (radius, height) as fractions of the height.
  constexpr glm::dvec2 kProfile[] = {
      {0.17, 0},     {0.175, 0.02}, {0.16, 0.04},  {0.1, 0.065}, {0.085, 0.09}, {0.1, 0.115},
      {0.16, 0.16},  {0.23, 0.24},  {0.285, 0.35}, {0.31, 0.46}, {0.31, 0.55},  {0.28, 0.64},
      {0.22, 0.72},  {0.15, 0.78},  {0.115, 0.83}, {0.11, 0.88}, {0.125, 0.93}, {0.165, 0.97},
      {0.19, 0.985}, {0.195, 1},    {0.18, 1},     {0.15, 0.97}, {0.105, 0.93}, {0.092, 0.88},
      {0.1, 0.82},   {0.19, 0.72},  {0.26, 0.62},  {0.28, 0.5},  {0.24, 0.3},   {0.1, 0.16}};
  std::vector<glm::dvec2> profile;
  for (const glm::dvec2& point : kProfile) profile.push_back(point * height);
  return lathe(profile, 24);
}

Solid pot(double radius) {
  constexpr glm::dvec2 kProfile[] = {{0.62, 0},    {0.64, 0.03}, {0.84, 1.1}, {0.96, 1.12},
                                     {1, 1.16},    {1, 1.36},    {0.97, 1.4}, {0.86, 1.4},
                                     {0.82, 1.36}, {0.78, 1.2}};
  std::vector<glm::dvec2> profile;
  for (const glm::dvec2& point : kProfile) profile.push_back(point * radius);
  return lathe(profile, 20);
}

Solid bench(double length) {
  Solid solid;
  const double half = length / 2;
  append(solid, box({-half, 0.4, -0.24}, {half, 0.5, 0.24}, 0.015));
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (half - 0.25);
    append(solid, box({x - 0.1, 0, -0.19}, {x + 0.1, 0.1, 0.19}, 0.01));
    append(solid, box({x - 0.07, 0.09, -0.16}, {x + 0.07, 0.42, 0.16}, 0.01));
  }
  return solid;
}

Solid drape(double width, double drop, double railRadius) {
  constexpr double kBehind = 0.45;
  const double over = railRadius * 3.14159265358979;
  const double length = kBehind + over + drop;
  return sheet(60, 24, [=](double u, double v) -> glm::dvec3 {
    const double along = v * length;
    const double x = (u - 0.5) * width;
    if (along < kBehind) return {x, along - kBehind, -railRadius};
    if (along < kBehind + over) {
      const double turn = (along - kBehind) / over / 2;
      return {x, railRadius * sinTurns(turn), -railRadius * cosTurns(turn)};
    }
    // Folds deepen with the distance from the rail and narrow the cloth.
    const double below = along - kBehind - over;
    const double depth = smoothUnit(below / 1.2);
    const double fold =
        sinTurns(5.5 * u + 0.2 * sinTurns(1.3 * u)) + 0.35 * sinTurns(9 * u + 0.3 + 0.1 * below);
    return {x * (1 - 0.1 * depth) + 0.012 * depth * cosTurns(11 * u), -below,
            railRadius + 0.26 * smoothUnit(below / 0.6) + 0.055 * depth * fold};
  });
}

Solid banner(double width, double drop) {
  return sheet(36, 24, [=](double u, double v) -> glm::dvec3 {
    const double depth = 0.25 + 0.75 * smoothUnit(v * 1.5);
    const double fold =
        sinTurns(4 * u + 0.15 * v) + 0.3 * sinTurns(9 * u + 0.4) * smoothUnit(2 * v);
    const double billow = 0.16 * sinTurns(v / 2) * sinTurns(u / 2);
    return {(u - 0.5) * width * (1 - 0.06 * v), -v * drop + 0.06 * v * sinTurns(u / 2),
            0.06 * depth * fold + billow};
  });
}

Solid plant(uint32_t leaves, double length, uint32_t seed) {
  Solid solid;
  for (uint32_t i = 0; i < leaves; ++i) {
    const auto random = [&](uint32_t salt) { return hashUnit((seed * 131 + i) * 8 + salt); };
    const double turn = (i + 0.6 * random(0)) / leaves;
    const double reach = length * (0.75 + 0.5 * random(1));
    const double rise = 1.25 - 1.1 * (i % 3) / 2.0 * (0.7 + 0.3 * random(2));
    const double width = 0.42 * reach * (0.8 + 0.4 * random(3));
    const double twist = 0.12 * (random(4) - 0.5);
    append(
        solid,
        sheet(
            2, 6,
            [=](double u, double v) -> glm::dvec3 {
              // v = 1 is the stem end of the leaf texture.
              const double t = 1 - v, side = (u - 0.5) * width;
              const double out = reach * (0.75 * t - 0.1 * t * t);
              const double up = reach * (rise * t - (0.35 + 0.4 * rise) * t * t);
              const double trough = 0.5 * std::abs(side);
              return {side * cosTurns(twist * t), up + trough + side * sinTurns(twist), 0.02 + out};
            }),
        turned(turn));
  }
  return solid;
}

}  // namespace grisaille::scene
