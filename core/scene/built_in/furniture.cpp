// SPDX-License-Identifier: MIT
#include "core/scene/built_in/furniture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grisaille::scene {
namespace {

// A square bar along y that narrows. sizes: half widths at the foot and at the top
Solid taper(const glm::dvec3& foot, const glm::dvec3& top, const glm::dvec2& halves) {
  const auto ring = [](const glm::dvec3& at, double half) {
    const double cut = 0.8 * half;
    Ring points;
    for (const glm::dvec2& p :
         {glm::dvec2(half, cut), glm::dvec2(cut, half), glm::dvec2(-cut, half),
          glm::dvec2(-half, cut), glm::dvec2(-half, -cut), glm::dvec2(-cut, -half),
          glm::dvec2(cut, -half), glm::dvec2(half, -cut)}) {
      points.emplace_back(at.x + p.x, at.y, at.z + p.y);
    }
    return points;
  };
  return loft(std::array{ring(foot, halves.x), ring(top, halves.y)}, false);
}

// The profile of a vessel with a wall: up the outside, over the lip, down the inside.
// outline: (radius, height) of the outside; a vessel's bottom is twice as thick as its wall
Solid vessel(std::span<const glm::dvec2> outline, double wall, uint32_t segments) {
  std::vector<glm::dvec2> profile(outline.begin(), outline.end());
  const glm::dvec2 lip = profile.back();
  profile.emplace_back(lip.x - 0.5 * wall, lip.y + 0.4 * wall);
  for (size_t i = outline.size(); i-- > 0;) {
    const double y = std::max(outline[i].y, outline[0].y + 2 * wall);
    const double x = std::max(outline[i].x - wall, wall);
    profile.emplace_back(x, i + 1 == outline.size() ? y - 0.1 * wall : y);
    if (outline[i].y < outline[0].y + 2 * wall) break;
  }
  return lathe(profile, segments);
}

}  // namespace

Solid diningTable(const glm::dvec3& size) {
  const double x = size.x / 2, y = size.y, z = size.z / 2;
  Solid solid = block({-x, y - 0.03, -z}, {x, y, z}, 0.006);
  const double legX = x - 0.07, legZ = z - 0.07;
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {-1.0, 1.0}) {
      append(solid, taper({end * legX, 0, side * legZ}, {end * legX, y - 0.015, side * legZ},
                          {0.021, 0.034}));
    }
    append(solid,
           box({-legX, y - 0.12, side * legZ - 0.011}, {legX, y - 0.02, side * legZ + 0.011}));
    append(solid,
           box({side * legX - 0.0112, y - 0.118, -legZ}, {side * legX + 0.0112, y - 0.02, legZ}));
  }
  return solid;
}

Solid chair() {
  Solid solid;
  constexpr double kSeat = 0.45;
  // The seat is a little narrower at the back.
  const std::array seat{glm::dvec2(0.2, 0.21),     glm::dvec2(0.225, 0.19),
                        glm::dvec2(0.2, -0.19),    glm::dvec2(0.18, -0.205),
                        glm::dvec2(-0.18, -0.205), glm::dvec2(-0.2, -0.19),
                        glm::dvec2(-0.225, 0.19),  glm::dvec2(-0.2, 0.21)};
  append(solid, prism(seat, kSeat - 0.022, kSeat, 0.006));
  for (const double side : {-1.0, 1.0}) {
    append(solid,
           taper({side * 0.205, 0, 0.19}, {side * 0.185, kSeat - 0.01, 0.165}, {0.012, 0.018}));
    const std::array back{
        glm::dvec3(side * 0.185, 0, -0.235), glm::dvec3(side * 0.178, 0.24, -0.195),
        glm::dvec3(side * 0.176, 0.46, -0.18), glm::dvec3(side * 0.18, 0.7, -0.205),
        glm::dvec3(side * 0.188, 0.96, -0.27)};
    append(solid, tube(curve(back, 3),
                       std::array{0.012, 0.013, 0.014, 0.0155, 0.017, 0.018, 0.0185, 0.018, 0.017,
                                  0.016, 0.015, 0.014, 0.013},
                       8));
    append(solid, box({side * 0.187 - 0.009, kSeat - 0.075, -0.18},
                      {side * 0.187 + 0.009, kSeat - 0.018, 0.165}));
    append(solid, tube({{side * 0.191, 0.2, -0.205}, {side * 0.198, 0.17, 0.18}}, 0.0085, 8));
  }
  append(solid, box({-0.185, kSeat - 0.076, 0.155}, {0.185, kSeat - 0.017, 0.172}));
  append(solid, box({-0.178, kSeat - 0.074, -0.19}, {0.178, kSeat - 0.017, -0.174}));
  append(solid, tube({{-0.195, 0.185, 0.0}, {0.195, 0.185, 0.0}}, 0.0085, 8));
  // Rails of the back, bent to the sitter's, and slats between them.
  constexpr glm::dvec2 kRail[] = {{-0.008, -0.028}, {0.008, -0.028}, {0.01, 0.0},
                                  {0.008, 0.028},   {-0.008, 0.028}, {-0.01, 0.0}};
  const auto rail = [&](double y, double z, double height) {
    std::vector<glm::dvec2> section;
    for (const glm::dvec2& p : kRail) section.emplace_back(p.x, p.y * height);
    append(solid, sweep(section,
                        curve(std::array{glm::dvec3(-0.186, y, z), glm::dvec3(-0.09, y, z - 0.022),
                                         glm::dvec3(0.09, y, z - 0.022), glm::dvec3(0.186, y, z)},
                              3),
                        {0, 1, 0}));
  };
  rail(0.915, -0.258, 1.5);
  rail(0.55, -0.187, 0.9);
  for (int k = 0; k < 6; ++k) {
    const double x = -0.13 + 0.052 * k, bend = 0.022 - 0.6 * x * x;
    const std::array slat{glm::dvec3(x, 0.54, -0.187 - bend), glm::dvec3(x, 0.72, -0.208 - bend),
                          glm::dvec3(1.04 * x, 0.9, -0.253 - bend)};
    append(solid, sweep(std::array{glm::dvec2(-0.011, -0.0045), glm::dvec2(0.011, -0.0045),
                                   glm::dvec2(0.011, 0.0045), glm::dvec2(-0.011, 0.0045)},
                        curve(slat, 3), {0, 0, 1}));
  }
  return solid;
}

Solid shelf(const glm::dvec3& size, uint32_t boards) {
  const double x = size.x / 2, h = size.y, d = size.z;
  Solid solid;
  for (const double side : {-1.0, 1.0}) {
    append(solid, block({side * x - 0.011, 0, 0}, {side * x + 0.011, h, d}, 0.002));
  }
  for (uint32_t k = 0; k < boards; ++k) {
    const double y = 0.07 + (h - 0.09) * k / (boards - 1);
    append(solid, block({-x + 0.002, y - 0.011, 0.003}, {x - 0.002, y + 0.011, d - 0.004}, 0.002));
  }
  append(solid, box({-x, 0.02, 0.004}, {x, h - 0.004, 0.01}));
  append(solid, box({-x, 0.002, d - 0.04}, {x, 0.062, d - 0.025}));
  return solid;
}

Solid book(const glm::dvec3& size) {
  const double x = size.x / 2, h = size.y, d = size.z, cover = 0.0022;
  Solid solid = box({-x + cover * 0.5, 0.003, -d + 0.003}, {x - cover * 0.5, h - 0.003, -0.002});
  for (const double side : {-1.0, 1.0}) {
    append(solid, box({side * x - cover * 0.5, 0, -d}, {side * x + cover * 0.5, h, -0.0045}));
  }
  // The spine is round.
  const double out = std::min(0.3 * x, 0.005);
  const std::array outline{glm::dvec2(x + 0.0008, -0.007),    glm::dvec2(x + 0.0008, -0.003),
                           glm::dvec2(0.5 * x, out - 0.001),  glm::dvec2(0, out),
                           glm::dvec2(-0.5 * x, out - 0.001), glm::dvec2(-x - 0.0008, -0.003),
                           glm::dvec2(-x - 0.0008, -0.007)};
  append(solid, prism(outline, 0.0004, h - 0.0004));
  return solid;
}

Solid bowl(double radius, double height) {
  const double r = radius, h = height;
  const std::array outline{glm::dvec2(0.36 * r, 0),
                           glm::dvec2(0.38 * r, 0.08 * h),
                           glm::dvec2(0.34 * r, 0.12 * h),
                           glm::dvec2(0.62 * r, 0.25 * h),
                           glm::dvec2(0.84 * r, 0.5 * h),
                           glm::dvec2(0.95 * r, 0.78 * h),
                           glm::dvec2(r, h)};
  return vessel(outline, 0.035 * r, 28);
}

Solid fruit(double radius, uint32_t seed) {
  Solid solid = ball(radius, 16, 11);
  for (glm::dvec3& p : solid.positions) {
    const glm::dvec3 unit = p / radius;
    const double across = unit.x * unit.x + unit.z * unit.z;
    // A dimple at both poles, the upper one deeper.
    p.y *= 1 - (unit.y > 0 ? 0.3 : 0.18) * (1 - smoothUnit(across / 0.35));
    p *= 1 + 0.04 * noise(2 * unit.x + seed, 2 * unit.y + 0.7 * unit.z, seed);
  }
  append(solid, tube({{0, 0.55 * radius, 0},
                      {0.04 * radius, 0.85 * radius, 0.02 * radius},
                      {0.16 * radius, 1.1 * radius, 0.05 * radius}},
                     0.045 * radius, 6));
  return solid;
}

Solid cup() {
  const std::array outline{glm::dvec2(0.022, 0),    glm::dvec2(0.024, 0.004),
                           glm::dvec2(0.03, 0.012), glm::dvec2(0.037, 0.03),
                           glm::dvec2(0.039, 0.05), glm::dvec2(0.042, 0.07)};
  Solid solid = vessel(outline, 0.0028, 24);
  const std::array handle{glm::dvec3(0.0385, 0.058, 0), glm::dvec3(0.055, 0.062, 0),
                          glm::dvec3(0.066, 0.05, 0), glm::dvec3(0.058, 0.03, 0),
                          glm::dvec3(0.035, 0.021, 0)};
  append(solid, tube(curve(handle, 4), 0.004, 8));
  return solid;
}

Solid saucer(double radius) {
  const double r = radius;
  const std::array outline{glm::dvec2(0.5 * r, 0), glm::dvec2(0.53 * r, 0.005),
                           glm::dvec2(0.8 * r, 0.01), glm::dvec2(r, 0.02)};
  return vessel(outline, 0.0032, 28);
}

Solid bottle(double height) {
  const double h = height;
  const std::array outline{glm::dvec2(0.115 * h, 0),        glm::dvec2(0.125 * h, 0.015 * h),
                           glm::dvec2(0.125 * h, 0.52 * h), glm::dvec2(0.115 * h, 0.6 * h),
                           glm::dvec2(0.06 * h, 0.72 * h),  glm::dvec2(0.045 * h, 0.8 * h),
                           glm::dvec2(0.042 * h, 0.93 * h), glm::dvec2(0.05 * h, 0.94 * h),
                           glm::dvec2(0.05 * h, 0.975 * h), glm::dvec2(0.045 * h, h)};
  return vessel(outline, 0.011 * h, 20);
}

Solid candlestick(double height) {
  const double h = height;
  const std::array profile{
      glm::dvec2(0.05, 0),         glm::dvec2(0.052, 0.006),    glm::dvec2(0.03, 0.012),
      glm::dvec2(0.014, 0.025),    glm::dvec2(0.011, 0.3 * h),  glm::dvec2(0.018, 0.34 * h),
      glm::dvec2(0.018, 0.38 * h), glm::dvec2(0.01, 0.42 * h),  glm::dvec2(0.013, 0.55 * h),
      glm::dvec2(0.03, 0.58 * h),  glm::dvec2(0.03, 0.595 * h), glm::dvec2(0.012, 0.585 * h)};
  Solid solid = lathe(profile, 20);
  append(solid, lathe(std::array{glm::dvec2(0.0105, 0.57 * h), glm::dvec2(0.01, h - 0.003),
                                 glm::dvec2(0.007, h), glm::dvec2(0.003, h - 0.004)},
                      14));
  append(solid,
         tube({{0, h - 0.006, 0}, {0.0005, h + 0.006, 0}, {0.003, h + 0.012, 0}}, 0.0009, 6));
  return solid;
}

Solid crate(const glm::dvec3& size, double wall) {
  const double x = size.x / 2, h = size.y, z = size.z / 2;
  Solid solid =
      box({-x + 0.3 * wall, 0.004, -z + 0.3 * wall}, {x - 0.3 * wall, wall, z - 0.3 * wall});
  const std::array side{
      glm::dvec2(0, 0),          glm::dvec2(wall, 0),       glm::dvec2(wall, h - 0.2 * wall),
      glm::dvec2(0.8 * wall, h), glm::dvec2(0.2 * wall, h), glm::dvec2(0, h - 0.2 * wall)};
  append(solid, frame(side, {x, z}));
  return solid;
}

Solid radiator(double length, double height) {
  Solid solid;
  const auto columns = static_cast<int>(length / 0.05);
  const double half = length / 2;
  for (int k = 0; k < columns; ++k) {
    const double x = (k + 0.5) * length / columns - half;
    for (const double z : {0.045, 0.105}) {
      append(solid, block({x - 0.016, 0.1, z - 0.022}, {x + 0.016, height, z + 0.022}, 0.01));
    }
    append(solid, block({x - 0.022, 0.115, 0.03}, {x + 0.022, 0.15, 0.12}, 0.008));
    append(solid,
           block({x - 0.022, height - 0.05, 0.03}, {x + 0.022, height - 0.015, 0.12}, 0.008));
  }
  for (const double y : {0.132, height - 0.032}) {
    append(solid, tube({{-half - 0.03, y, 0.075}, {half + 0.03, y, 0.075}}, 0.014, 10));
  }
  append(
      solid,
      tube(
          bent(Path{{half, 0.131, 0.075}, {half + 0.06, 0.131, 0.075}, {half + 0.06, -0.05, 0.075}},
               0.025, 4),
          0.009, 8));
  append(solid,
         lathe(std::array{glm::dvec2(0.02, 0), glm::dvec2(0.024, 0.01), glm::dvec2(0.024, 0.05),
                          glm::dvec2(0.018, 0.06)},
               12),
         moved({half + 0.02, height - 0.032, 0.075}) * turnedZ(-0.25));
  for (const double x : {-0.7 * half, 0.7 * half}) {
    append(solid, box({x - 0.012, -0.02, 0.06}, {x + 0.012, 0.13, 0.09}));
  }
  return solid;
}

HangingLamp hangingLamp(double length, double radius) {
  HangingLamp lamp;
  const double l = length, r = radius;
  lamp.cord = tube(
      {{0, 0.05, 0}, {0.002, -0.3 * l, 0.001}, {-0.001, -0.7 * l, 0}, {0, 0.06 - l, 0}}, 0.003, 8);
  append(lamp.cord, lathe(std::array{glm::dvec2(0.05, 0.02), glm::dvec2(0.05, -0.004),
                                     glm::dvec2(0.04, -0.022), glm::dvec2(0.008, -0.03)},
                          20));
  append(lamp.cord, lathe(std::array{glm::dvec2(0.008, -l + 0.075), glm::dvec2(0.02, -l + 0.06),
                                     glm::dvec2(0.022, -l + 0.01), glm::dvec2(0.016, -l - 0.05)},
                          16));
  append(lamp.cord, ball(0.034, 18, 12), moved({0, -l - 0.075, 0}));
  const std::array shade{glm::dvec2(0.18 * r, 0.62 * r),  glm::dvec2(0.34 * r, 0.6 * r),
                         glm::dvec2(0.62 * r, 0.46 * r),  glm::dvec2(0.86 * r, 0.24 * r),
                         glm::dvec2(0.97 * r, 0.04 * r),  glm::dvec2(r, 0),
                         glm::dvec2(0.985 * r, 0),        glm::dvec2(0.95 * r, 0.045 * r),
                         glm::dvec2(0.84 * r, 0.235 * r), glm::dvec2(0.6 * r, 0.45 * r),
                         glm::dvec2(0.32 * r, 0.585 * r), glm::dvec2(0.16 * r, 0.6 * r)};
  lamp.shade = lathe(shade, 32);
  for (glm::dvec3& p : lamp.shade.positions) p.y -= l + 0.4 * r;
  return lamp;
}

Solid curtain(double width, double drop, uint32_t folds) {
  return sheet(14 * folds, 12, [=](double u, double v) -> glm::dvec3 {
    // Folds widen and wander a little on their way down.
    const double wander = 0.03 * sinTurns(1.7 * u) * v;
    const double wave = sinTurns(folds * (u + wander)), half = sinTurns(2 * folds * (u + wander));
    const double deep = 0.014 + 0.01 * smoothUnit(v * 1.6) + 0.008 * sinTurns(3.1 * u + 0.4);
    const double hem = 0.006 * wave * v;
    return {(u - 0.5) * width * (1 + 0.05 * v) + 0.002 * half * (0.5 + v), -drop * v + hem,
            deep * wave + 0.012 * v * sinTurns(2.3 * u + 0.2)};
  });
}

Solid runner(double half, double width, double drop) {
  const double length = 2 * (half + drop);
  return sheet(72, 10, [=](double u, double v) -> glm::dvec3 {
    const double along = (u - 0.5) * length, z = (v - 0.5) * width;
    const double over = std::abs(along) - half, side = along < 0 ? -1 : 1;
    const double ripple = 0.0012 + 0.001 * noise(9 * along, 9 * z, 31);
    constexpr double kRound = 0.012;  // of the fold over the edge
    if (over < 0) return {along, ripple, z};
    const double turn = std::min(over / (6.283185 * kRound), 0.25);
    const double below = std::max(over - 1.5708 * kRound, 0.0);
    const double wave = 0.02 * smoothUnit(below / 0.15) * sinTurns(1.6 * v + 0.1 * side);
    return {side * (half + kRound * sinTurns(turn) + 0.0025 + wave + 0.05 * below),
            ripple - kRound * (1 - cosTurns(turn)) - below, z * (1 - 0.1 * below)};
  });
}

Solid rug(const glm::dvec2& size) {
  const glm::dvec2 half = 0.5 * size;
  return ground(-half, half, {30, 22}, 0.0005, [&](double x, double z) {
    const double edge = std::min(half.x - std::abs(x), half.y - std::abs(z));
    return 0.004 + 0.004 * smoothUnit(edge / 0.05) + 0.0022 * noise(7 * x, 7 * z, 3);
  });
}

}  // namespace grisaille::scene
