// SPDX-License-Identifier: MIT
#include "core/scene/built_in/machine_parts.h"

#include <algorithm>
#include <array>

namespace grisaille::scene {
namespace {

// Turns +y to +x.
glm::dmat4 lying() {
  return turnedZ(-0.25);
}

Solid disc(double radius, double low, double high, uint32_t segments, double bevel = 0) {
  if (bevel <= 0)
    return lathe(std::array{glm::dvec2(radius, low), glm::dvec2(radius, high)}, segments);
  return lathe(std::array{glm::dvec2(radius, low), glm::dvec2(radius, high - bevel),
                          glm::dvec2(radius - bevel, high)},
               segments);
}

// A hexagonal head without a washer.
Solid boltHead(double radius) {
  const double edge = 1.1547 * radius;  // of the hexagon's corners
  return lathe(std::array{glm::dvec2(edge, -0.3 * radius), glm::dvec2(edge, 1.4 * radius)}, 6);
}

// A fan cover up to the height `to`: a bowl with a ring grille in its opening.
Solid fanCover(double radius, double to) {
  constexpr double kWall = 0.006;
  const std::array bowl{glm::dvec2(0.6 * radius, 0),
                        glm::dvec2(radius, 0.01),
                        glm::dvec2(radius, to - 0.015),
                        glm::dvec2(radius - 0.015, to),
                        glm::dvec2(0.8 * radius, to),
                        glm::dvec2(0.8 * radius, to - kWall),
                        glm::dvec2(radius - 0.02, to - kWall - 0.002),
                        glm::dvec2(radius - kWall, to - 0.025),
                        glm::dvec2(radius - kWall, 0.02)};
  Solid solid = lathe(bowl, 24);
  for (int k = 0; k < 4; ++k) {
    append(solid, torus(radius * (0.15 + 0.2 * k), 0.0025, 20, 5), moved({0, to - 0.004, 0}));
  }
  for (int k = 0; k < 4; ++k) {
    append(solid,
           tube({{-0.83 * radius, to - 0.0075, 0}, {0.83 * radius, to - 0.0075, 0}}, 0.0025, 6),
           turned(0.125 * k + 0.06));
  }
  return solid;
}

}  // namespace

Solid bolt(double radius) {
  Solid solid = disc(1.55 * radius, -0.3 * radius, 0.28 * radius, 10);
  append(solid, boltHead(radius));
  return solid;
}

Solid boltCircle(double circle, double radius, uint32_t count) {
  Solid solid;
  const Solid one = boltHead(radius);
  for (uint32_t k = 0; k < count; ++k) {
    append(solid, one, turned((k + 0.5) / count) * moved({circle, 0, 0}) * turned(0.07 * k));
  }
  return solid;
}

Solid flangePair(double pipeRadius) {
  Solid solid;
  const double r = pipeRadius, thick = 0.2 * r + 0.004;
  for (const double side : {0.0, 0.5}) {
    const glm::dmat4 way = turnedX(side) * moved({0, 0.0015, 0});
    append(solid, disc(1.85 * r, 0, thick, 20, 0.12 * thick), way);
    append(
        solid,
        lathe(std::array{glm::dvec2(1.3 * r, 0.9 * thick), glm::dvec2(1.08 * r, 2.2 * thick)}, 16),
        way);
    append(solid, boltCircle(1.55 * r, 0.13 * r, 6), way * moved({0, thick, 0}));
  }
  append(solid, disc(1.6 * r, -0.003, 0.003, 16));
  return solid;
}

Solid pipe(const Path& line, double radius, bool flanged) {
  Solid solid = tube(bent(line, 2.6 * radius, 6), radius, 16);
  if (!flanged) return solid;
  const Solid pair = flangePair(radius);
  const auto end = [&](const glm::dvec3& at, const glm::dvec3& next) {
    append(solid, pair, aimed(at + 0.9 * radius * glm::normalize(next - at), next - at));
  };
  end(line.front(), line[1]);
  end(line.back(), line[line.size() - 2]);
  return solid;
}

Solid valve(double pipeRadius) {
  const double r = pipeRadius;
  const std::array body{glm::dvec2(1.02 * r, -2.6 * r), glm::dvec2(1.15 * r, -1.8 * r),
                        glm::dvec2(1.6 * r, -0.9 * r),  glm::dvec2(1.75 * r, 0),
                        glm::dvec2(1.6 * r, 0.9 * r),   glm::dvec2(1.15 * r, 1.8 * r),
                        glm::dvec2(1.02 * r, 2.6 * r)};
  Solid solid = lathe(body, 16);
  const glm::dmat4 front = turnedX(0.25);  // +y to +z
  const std::array bonnet{glm::dvec2(1.1 * r, 0.8 * r),   glm::dvec2(1.0 * r, 2.0 * r),
                          glm::dvec2(1.45 * r, 2.05 * r), glm::dvec2(1.45 * r, 2.4 * r),
                          glm::dvec2(0.6 * r, 2.5 * r),   glm::dvec2(0.45 * r, 3.6 * r),
                          glm::dvec2(0.3 * r, 3.65 * r),  glm::dvec2(0.16 * r, 4.7 * r)};
  append(solid, lathe(bonnet, 14), front);
  append(solid, boltCircle(1.25 * r, 0.11 * r, 6), front * moved({0, 2.4 * r, 0}));
  append(solid, torus(1.9 * r, 0.2 * r, 22, 7), front * moved({0, 4.4 * r, 0}));
  append(solid, disc(0.42 * r, 4.2 * r, 4.75 * r, 12, 0.06 * r), front);
  for (int k = 0; k < 3; ++k) {
    append(
        solid,
        tube({{0.2 * r, 4.5 * r, 0}, {1.1 * r, 4.35 * r, 0}, {1.9 * r, 4.4 * r, 0}}, 0.13 * r, 7),
        front * turned(k / 3.0 + 0.03));
  }
  for (const double end : {0.0, 0.5}) {
    append(solid, flangePair(r), turnedX(end) * moved({0, 2.7 * r, 0}));
  }
  return solid;
}

Solid iBeam(double length, double height, double width) {
  const double half = length / 2, web = 0.035 * width, flange = 0.06 * height;
  Solid solid = box({-half, -height + 0.4 * flange, -web}, {half, -0.4 * flange, web});
  append(solid, box({-half - 0.001, -flange, -width / 2}, {half + 0.001, 0, width / 2}));
  append(solid,
         box({-half - 0.001, -height, -width / 2}, {half + 0.001, -height + flange, width / 2}));
  // The fillets at the web.
  for (const double y : {-height + flange, -flange}) {
    append(solid, tube({{-half + 0.002, y, 0}, {half - 0.002, y, 0}}, 2.2 * web, 8));
  }
  return solid;
}

Solid gratingPanel(const glm::dvec2& size, double pitch, double height) {
  Solid solid;
  constexpr double kHalf = 0.0025;  // of a bar's thickness
  const glm::dvec2 half = 0.5 * size;
  const std::array rim{glm::dvec2(0, -height - 0.001), glm::dvec2(2 * kHalf, -height - 0.001),
                       glm::dvec2(2 * kHalf, 0.001), glm::dvec2(0, 0.001)};
  append(solid, frame(rim, half));
  const auto bars = static_cast<int>(size.x / pitch);
  const double step = size.x / bars;
  for (int k = 1; k < bars; ++k) {
    const double x = k * step - half.x;
    append(solid, box({x - kHalf, -height, -half.y + kHalf}, {x + kHalf, 0, half.y - kHalf}));
  }
  constexpr double kRods = 0.1;
  const auto rods = static_cast<int>(size.y / kRods);
  for (int k = 0; k < rods; ++k) {
    const double z = (k + 0.5) * size.y / rods - half.y;
    std::vector<Ring> rings;
    for (int i = 0; i <= bars; ++i) {
      const double x = std::clamp(i * step - half.x, kHalf - half.x, half.x - kHalf);
      Ring& ring = rings.emplace_back();
      for (int corner = 0; corner < 4; ++corner) {
        const double turn = 0.25 * corner + 0.15 * i;
        ring.emplace_back(x, -0.0052 + 0.0045 * sinTurns(turn), z + 0.0045 * cosTurns(turn));
      }
    }
    append(solid, loft(rings, false));
  }
  return solid;
}

Solid motor(double axis) {
  Solid solid;
  const double r = 0.62 * axis;  // of the stator
  const glm::dmat4 way = moved({0, axis, 0}) * lying();
  append(solid, disc(r, -0.17, 0.17, 28), way);
  for (int k = 0; k < 26; ++k) {
    const double turn = (k + 0.5) / 26;
    if (turn > 0.18 && turn < 0.32) continue;  // below the terminal box
    append(solid, box({r - 0.004, -0.165, -0.0025}, {r + 0.026, 0.165, 0.0025}),
           way * turned(turn + 0.25));
  }
  const std::array bell{glm::dvec2(r + 0.022, 0.155), glm::dvec2(r + 0.024, 0.19),
                        glm::dvec2(r + 0.01, 0.2),    glm::dvec2(0.62 * r, 0.215),
                        glm::dvec2(0.42 * r, 0.24),   glm::dvec2(0.36 * r, 0.255)};
  append(solid, lathe(bell, 24), way);
  append(solid, disc(0.17 * r, 0.2, 0.36, 16, 0.003), way);
  append(solid, boltCircle(r - 0.005, 0.006, 4), way * moved({0, 0.2, 0}));
  const std::array rear{glm::dvec2(r + 0.022, -0.155), glm::dvec2(r + 0.022, -0.185),
                        glm::dvec2(0.8 * r, -0.2)};
  append(solid, lathe(rear, 24), way);
  append(solid, fanCover(r + 0.034, 0.13), way * moved({0, -0.175, 0}) * turnedX(0.5));
  for (const double x : {-0.1, 0.1}) {
    for (const double z : {-0.62, 0.62}) {
      append(solid, box({x - 0.035, 0, z * r - 0.035}, {x + 0.035, 0.016, z * r + 0.035}, 0.003));
      append(solid,
             box({x - 0.02, 0.008, z * r - 0.011}, {x + 0.02, axis - 0.6 * r, z * r + 0.011}));
      append(solid, bolt(0.008), moved({x + (x < 0 ? 0.003 : -0.003), 0.016, 1.32 * z * r}));
    }
  }
  const double top = axis + r;
  append(solid, block({-0.06, top - 0.03, -0.055}, {0.06, top + 0.05, 0.055}, 0.006));
  append(solid, block({-0.066, top + 0.048, -0.061}, {0.066, top + 0.06, 0.061}, 0.004));
  for (const double x : {-0.05, 0.05}) {
    for (const double z : {-0.045, 0.045}) append(solid, bolt(0.004), moved({x, top + 0.06, z}));
  }
  return solid;
}

Solid gearCase(double axis) {
  Solid solid = block({-0.17, 0.012, -0.15}, {0.17, axis + 0.16, 0.15}, 0.016);
  append(solid, block({-0.2, 0, -0.19}, {0.2, 0.022, 0.19}, 0.004));
  append(solid, block({-0.19, axis - 0.012, -0.17}, {0.19, axis + 0.014, 0.17}, 0.004));
  append(solid, block({-0.11, axis + 0.15, -0.09}, {0.1, axis + 0.172, 0.09}, 0.005));
  for (int k = 0; k < 6; ++k) {
    const double x = -0.14 + 0.056 * k;
    for (const double z : {-0.158, 0.158}) {
      append(solid, bolt(0.009), moved({x, axis + 0.014, z}) * turned(0.04 * k));
    }
    if (k == 2 || k == 3) continue;
    append(solid, box({x - 0.005, 0.02, -0.172}, {x + 0.005, axis - 0.01, 0.172}));
    append(solid, box({x - 0.004, axis, -0.163}, {x + 0.004, axis + 0.13, 0.163}));
  }
  for (const double way : {-0.25, 0.25}) {
    const glm::dmat4 end = moved({0, axis, 0}) * turnedZ(way);
    const std::array boss{glm::dvec2(0.105, 0.15), glm::dvec2(0.105, 0.182),
                          glm::dvec2(0.1, 0.187),  glm::dvec2(0.06, 0.187),
                          glm::dvec2(0.055, 0.2),  glm::dvec2(0.035, 0.2)};
    append(solid, lathe(boss, 20), end);
    append(solid, boltCircle(0.083, 0.007, 8), end * moved({0, 0.187, 0}));
    append(solid, disc(0.024, 0.18, 0.3, 16, 0.003), end);
  }
  for (const double x : {-0.17, 0.17}) {
    for (const double z : {-0.16, 0.16}) append(solid, bolt(0.01), moved({x, 0.022, z}));
  }
  const glm::dmat4 eye = moved({0.135, axis + 0.185, 0}) * turnedX(0.25);
  append(solid, torus(0.024, 0.007, 20, 8), eye);
  append(solid, disc(0.014, axis + 0.155, axis + 0.17, 12), moved({0.135, 0, 0}));
  // A breather on the cover and an oil gauge at the side.
  append(solid, disc(0.016, axis + 0.17, axis + 0.21, 12, 0.004), moved({-0.05, 0, 0.02}));
  append(solid, disc(0.03, 0.15, 0.162, 20, 0.003), moved({0, 0.6 * axis, 0}) * turnedX(0.25));
  return solid;
}

Solid tank(double length, double radius, double axis) {
  const double half = length / 2, r = radius;
  std::vector<glm::dvec2> profile;
  for (int k = 0; k <= 6; ++k) {  // the domed ends
    const double turn = 0.24 * k / 6 + 0.01;
    profile.emplace_back(r * sinTurns(turn), -half - 0.4 * r * cosTurns(turn));
  }
  for (int k = 6; k >= 0; --k)
    profile.emplace_back(profile[static_cast<size_t>(k)].x, -profile[static_cast<size_t>(k)].y);
  const glm::dmat4 way = moved({0, axis, 0}) * lying();
  Solid solid;
  append(solid, lathe(profile, 32), way);
  for (const double x : {-0.98, -0.36, 0.31, 0.97}) {
    const std::array hoop{
        glm::dvec2(r - 0.01, x * half - 0.022), glm::dvec2(r + 0.007, x * half - 0.022),
        glm::dvec2(r + 0.007, x * half + 0.022), glm::dvec2(r - 0.01, x * half + 0.022)};
    append(solid, lathe(hoop, 32), way);
  }
  for (const double x : {-0.62, 0.62}) {
    // A saddle: a plate below the tank, hollowed by it, on a foot.
    append(solid,
           box({x * half - 0.02, 0.01, -0.85 * r}, {x * half + 0.02, axis - 0.5 * r, 0.85 * r}));
    append(solid, box({x * half - 0.09, 0, -0.95 * r}, {x * half + 0.09, 0.02, 0.95 * r}, 0.003));
    for (const double z : {-0.8, 0.8}) {
      append(solid, box({x * half - 0.075, 0.015, z * r - 0.006},
                        {x * half + 0.075, axis - 0.55 * r, z * r + 0.006}));
      append(solid, bolt(0.012), moved({x * half + 0.06, 0.02, 0.88 * z * r}));
    }
  }
  // The manhole.
  const glm::dmat4 side = moved({0.08 * half, axis, 0}) * turnedX(0.17);
  append(solid, disc(0.4 * r, 0.8 * r, 1.1 * r, 24), side);
  append(solid, disc(0.5 * r, 1.07 * r, 1.12 * r, 24, 0.004), side);
  append(solid, disc(0.51 * r, 1.125 * r, 1.17 * r, 24, 0.006), side);
  append(solid, boltCircle(0.455 * r, 0.009, 14), side * moved({0, 1.17 * r, 0}));
  append(solid,
         tube(bent(Path{{-0.05, 1.16 * r, 0.07},
                        {-0.05, 1.16 * r + 0.05, 0.07},
                        {-0.05, 1.16 * r + 0.05, -0.07},
                        {-0.05, 1.16 * r, -0.07}},
                   0.02, 4),
              0.007, 8),
         side);
  return solid;
}

Solid drum(double height) {
  const double h = height, r = 0.33 * h;
  const std::array profile{glm::dvec2(r, 0),
                           glm::dvec2(1.02 * r, 0.005 * h),
                           glm::dvec2(1.02 * r, 0.02 * h),
                           glm::dvec2(r, 0.03 * h),
                           glm::dvec2(r, 0.32 * h),
                           glm::dvec2(1.04 * r, 0.335 * h),
                           glm::dvec2(1.04 * r, 0.345 * h),
                           glm::dvec2(r, 0.36 * h),
                           glm::dvec2(r, 0.65 * h),
                           glm::dvec2(1.04 * r, 0.665 * h),
                           glm::dvec2(1.04 * r, 0.675 * h),
                           glm::dvec2(r, 0.69 * h),
                           glm::dvec2(r, 0.97 * h),
                           glm::dvec2(1.03 * r, 0.98 * h),
                           glm::dvec2(1.03 * r, h),
                           glm::dvec2(0.98 * r, h),
                           glm::dvec2(0.96 * r, 0.975 * h)};
  Solid solid = lathe(profile, 24);
  append(solid, disc(0.1 * r, 0.96 * h, 0.995 * h, 12, 0.004), moved({0.6 * r, 0, 0.2 * r}));
  return solid;
}

Solid cabinet(const glm::dvec3& size) {
  Solid solid;
  const double w = size.x / 2, h = size.y, d = size.z;
  append(solid, block({-w, 0, -0.01}, {w, h, d}, 0.008));
  const auto at = [&](double x, double y) { return moved({x, y, d + 0.018}); };
  // The door: louvres are slots near its lower and upper edge.
  std::vector<double> ys{0.03 * h, 0.1 * h};
  for (int k = 0; k < 16; ++k) ys.push_back(0.1 * h + 0.012 * (k + 1));
  ys.insert(ys.end(), {0.8 * h, 0.9 * h, 0.97 * h});
  const std::array xs{-0.94 * w, -0.6 * w, 0.6 * w, 0.94 * w};
  append(solid,
         recessedWall(
             xs, ys,
             [](uint32_t i, uint32_t j) {
               if (i != 1) return 0.0;
               return j > 1 && j < 17 && j % 2 == 0 ? 0.01 : j == 18 ? 0.006 : 0.0;
             },
             0.022),
         moved({0, 0, d + 0.018}));
  append(solid, block({-0.012, -0.06, -0.004}, {0.012, 0.06, 0.006}, 0.003), at(0.8 * w, 0.52 * h));
  append(solid, block({-0.009, -0.05, 0.004}, {0.009, 0.02, 0.03}, 0.004), at(0.8 * w, 0.52 * h));
  for (const double y : {0.15, 0.85}) {
    append(solid,
           tube({{-0.955 * w, y * h - 0.04, d + 0.012}, {-0.955 * w, y * h + 0.04, d + 0.012}},
                0.009, 10));
  }
  return solid;
}

}  // namespace grisaille::scene
