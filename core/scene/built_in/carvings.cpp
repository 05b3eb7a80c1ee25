// SPDX-License-Identifier: MIT
#include "core/scene/built_in/carvings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grisaille::scene {

Solid rosette(double radius, double height, uint32_t petals, uint32_t segmentsPerPetal) {
  constexpr double kSteps[] = {1, 1, 0.94, 0.84, 0.7, 0.54, 0.38, 0.24, 0.14};
  const uint32_t segments = petals * segmentsPerPetal;
  std::vector<Ring> rings;
  for (size_t i = 0; i < std::size(kSteps); ++i) {
    Ring& ring = rings.emplace_back();
    for (uint32_t k = 0; k < segments; ++k) {
      const double turn = static_cast<double>(k) / segments;
      const double within =
          std::abs(2 * (turn * petals - std::floor(turn * petals)) - 1);  // 0: middle
      const double round = std::sqrt(std::max(1 - within * within, 0.0));
      const double t = kSteps[i], tip = 0.7 + 0.3 * round;
      const double r = radius * (t * tip + (1 - t) * 0.14 * 0.5);
      // Petals rise from the hollow, arch, and fall to their tips, with a vein in the middle.
      const double arch = smoothUnit(t / 0.55) * (1 - 0.55 * smoothUnit((t - 0.6) / 0.45));
      const double across = 0.45 + 0.55 * round, vein = 0.14 * (1 - smoothUnit(within / 0.28)) * t;
      const double y = i == 0 ? -0.3 * height : height * (0.12 + 0.88 * arch * across - vein);
      ring.emplace_back(r * cosTurns(turn), y, r * sinTurns(turn));
    }
  }
  return loft(rings, false);
}

Solid scroll(double size) {
  Path stem;
  std::vector<double> radii;
  constexpr int kSteps = 34;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    // A straight start, then two turns of a spiral round (size, -0.42 * size).
    const double turn = 0.25 - 1.7 * t,
                 r = 0.42 * size * (1 - 0.86 * smoothUnit(0.2 + 0.8 * t) + 0.09);
    const double x = size * (0.75 + 0.25 * t) + r * cosTurns(turn),
                 z = -0.42 * size + r * sinTurns(turn);
    const double start = 1 - smoothUnit(t * 6);
    stem.emplace_back(x * (1 - start) + start * size * 4.5 * t, 0.02 * size + 0.05 * size * t,
                      z * (1 - start));
    radii.push_back(size * (0.1 - 0.055 * t));
  }
  Solid solid = tube(stem, radii, 9);
  append(solid, ball(0.085 * size, 12, 8), moved({stem.back().x, 0.03 * size, stem.back().z}));
  const auto leaf = [&](size_t at, double turn, double length) {
    append(solid, ball(1, 10, 7),
           moved(stem[at]) * turned(turn) * moved({0.8 * length, -0.01 * size, 0}) *
               scaled({length, 0.1 * size, 0.3 * length}));
  };
  leaf(4, -0.08, 0.2 * size);
  leaf(9, 0.0, 0.17 * size);
  leaf(14, 0.2, 0.13 * size);
  leaf(3, 0.13, 0.16 * size);
  return solid;
}

Solid chain(const Path& line, double wire) {
  const double half = 4.5 * wire, inner = half - 2 * wire, width = 1.9 * wire;
  const double pitch = 2 * inner + 0.3 * wire;
  Path link;  // a stadium in the xz plane, along x
  for (int k = 0; k < 16; ++k) {
    const double turn = k / 16.0, straight = half - wire - width;
    const double c = cosTurns(turn);
    link.emplace_back(width * c + (c > 1e-9    ? straight
                                   : c < -1e-9 ? -straight
                                               : 0),
                      0, width * sinTurns(turn));
  }
  const Solid one = hoop(link, wire, 6);
  Solid solid;
  double wanted = pitch / 2, gone = 0;
  int count = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec3 step = line[i + 1] - line[i];
    const double length = glm::length(step);
    while (wanted < gone + length) {
      const glm::dvec3 x = step / length, up(0, 1, 0);
      const glm::dvec3 z = glm::normalize(glm::cross(x, up)), y = glm::cross(z, x);
      glm::dmat4 place(1);
      place[0] = glm::dvec4(x, 0);
      place[1] = glm::dvec4(y, 0);
      place[2] = glm::dvec4(z, 0);
      place[3] = glm::dvec4(line[i] + (wanted - gone) * x, 1);
      // Links lean to either side in turn.
      append(solid, one,
             place * turnedX((count % 2 == 0 ? 0.125 : -0.125) +
                             0.012 * hashUnit(static_cast<uint32_t>(count))));
      wanted += pitch;
      ++count;
    }
    gone += length;
  }
  return solid;
}

Solid comb(double length, double tooth, uint32_t teeth) {
  const double half = length / 2, spine = 0.4 * tooth, thick = 0.0017;
  // The spine is arched: its outline runs along x and back.
  std::vector<Ring> rings;
  constexpr int kSteps = 16;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = 2.0 * k / kSteps - 1, x = half * t;
    const double top = spine * (1.15 - 0.5 * t * t * t * t);
    rings.push_back({{x, -0.0006, thick},
                     {x, 0.6 * top, 1.15 * thick},
                     {x, 0.93 * top, 0.8 * thick},
                     {x, top, 0.2 * thick},
                     {x, top, -0.2 * thick},
                     {x, 0.93 * top, -0.8 * thick},
                     {x, 0.6 * top, -1.15 * thick},
                     {x, -0.0006, -thick}});
  }
  Solid solid = loft(rings, false);
  const auto prong = [&](double x, double wide, double tip) {
    const auto ring = [&](double y, double w, double z) {
      return Ring{{x - w, y, -z}, {x + w, y, -z}, {x + w, y, z}, {x - w, y, z}};
    };
    append(solid, loft(std::array{ring(0.001, wide, 0.85 * thick),
                                  ring(-0.7 * tooth, 0.85 * wide, 0.7 * thick),
                                  ring(-tooth, tip, 0.25 * thick)},
                       false));
  };
  const double guard = 0.03 * length, pitch = (length - 2 * guard) / teeth;
  for (uint32_t k = 0; k < teeth; ++k) {
    prong((k + 0.5) * pitch - half + guard, 0.27 * pitch, 0.12 * pitch);
  }
  for (const double side : {-1.0, 1.0})
    prong(side * (half - 0.42 * guard), 0.4 * guard, 0.2 * guard);
  return solid;
}

Solid fingerRing(double radius) {
  std::vector<Ring> rings;
  constexpr int kSteps = 40;
  for (int k = 0; k < kSteps; ++k) {
    const double turn = static_cast<double>(k) / kSteps, c = cosTurns(turn), s = sinTurns(turn);
    Ring& ring = rings.emplace_back();
    for (const glm::dvec2& p :
         {glm::dvec2(0, 0.1), glm::dvec2(0.05, 0), glm::dvec2(0.11, 0.05), glm::dvec2(0.14, 0.25),
          glm::dvec2(0.11, 0.45), glm::dvec2(0.05, 0.5), glm::dvec2(0, 0.4)}) {
      const double r = radius * (1 + p.x);
      ring.emplace_back(r * c, radius * p.y, r * s);
    }
  }
  return loft(rings, true);
}

Solid jewelRing(double radius) {
  Solid solid = torus(1.06 * radius, 0.085 * radius, 36, 9);
  for (glm::dvec3& p : solid.positions) p.y += 0.085 * radius;
  const glm::dmat4 top = moved({1.1 * radius, 0.085 * radius, 0}) * turnedZ(-0.25);
  const double r = radius;
  append(solid,
         lathe(std::array{glm::dvec2(0.1 * r, -0.04 * r), glm::dvec2(0.26 * r, 0.14 * r),
                          glm::dvec2(0.22 * r, 0.16 * r)},
               16),
         top);
  append(solid,
         lathe(std::array{glm::dvec2(0.08 * r, 0.06 * r), glm::dvec2(0.32 * r, 0.3 * r),
                          glm::dvec2(0.32 * r, 0.33 * r), glm::dvec2(0.19 * r, 0.43 * r)},
               8),
         top);
  for (int k = 0; k < 4; ++k) {
    append(solid,
           tube({{0.2 * r, 0.1 * r, 0},
                 {0.335 * r, 0.27 * r, 0},
                 {0.325 * r, 0.36 * r, 0},
                 {0.28 * r, 0.4 * r, 0}},
                0.03 * r, 6),
           top * turned(0.25 * k + 0.06));
  }
  return solid;
}

Solid coin(double radius, double height) {
  const double r = radius, h = height;
  Solid solid = lathe(
      std::array{glm::dvec2(0.97 * r, 0), glm::dvec2(r, 0.1 * h), glm::dvec2(r, 0.9 * h),
                 glm::dvec2(0.97 * r, h), glm::dvec2(0.9 * r, h), glm::dvec2(0.87 * r, 0.82 * h)},
      32);
  append(solid, rosette(0.5 * r, 0.2 * h, 5, 8), moved({0, 0.8 * h, 0}));
  for (int k = 0; k < 14; ++k) {
    append(solid,
           lathe(std::array{glm::dvec2(0.035 * r, 0.75 * h), glm::dvec2(0.02 * r, 0.95 * h)}, 6),
           turned(k / 14.0) * moved({0.74 * r, 0, 0}));
  }
  return solid;
}

Solid spool(double radius, double height) {
  const double r = radius, h = height;
  const std::array profile{glm::dvec2(0.95 * r, 0),        glm::dvec2(r, 0.02 * h),
                           glm::dvec2(r, 0.1 * h),         glm::dvec2(0.93 * r, 0.14 * h),
                           glm::dvec2(0.56 * r, 0.21 * h), glm::dvec2(0.54 * r, 0.79 * h),
                           glm::dvec2(0.93 * r, 0.86 * h), glm::dvec2(r, 0.9 * h),
                           glm::dvec2(r, 0.98 * h),        glm::dvec2(0.95 * r, h),
                           glm::dvec2(0.3 * r, h),         glm::dvec2(0.27 * r, 0.97 * h),
                           glm::dvec2(0.26 * r, 0.6 * h)};
  return lathe(profile, 28);
}

Solid thread(double radius, double low, double high, double width) {
  Path path;
  constexpr int kSegments = 18;
  const int turns = static_cast<int>((high - low) / (1.04 * width));
  for (int k = 0; k <= turns * kSegments; ++k) {
    const double turn = static_cast<double>(k) / kSegments, share = turn / turns;
    const double bulge =
        1 + 0.05 * sinTurns(share / 2) + 0.012 * hashUnit(static_cast<uint32_t>(turn));
    path.emplace_back(radius * bulge * cosTurns(turn), low + (high - low) * share,
                      radius * bulge * sinTurns(turn));
  }
  // The loose end leaves the spool and comes to rest on the ground.
  const glm::dvec3 last = path.back();
  const std::array end{last,
                       last + glm::dvec3(-0.001, -0.001, 0.004),
                       glm::dvec3(1.5 * radius, 0.6 * high, 1.2 * radius),
                       glm::dvec3(2.0 * radius, 0.5 * width, 2.2 * radius),
                       glm::dvec3(3.2 * radius, 0.55 * width, 2.8 * radius),
                       glm::dvec3(4.2 * radius, 0.5 * width, 2.2 * radius),
                       glm::dvec3(4.6 * radius, 0.55 * width, 3.4 * radius)};
  const Path loose = curve(end, 7);
  path.insert(path.end(), loose.begin() + 1, loose.end());
  return tube(path, width / 2, 5);
}

Die die(double size) {
  Die made;
  const double h = size / 2;
  made.body = block({-h, 0, -h}, {h, size, h}, 0.11 * size);
  const Solid pip =
      lathe(std::array{glm::dvec2(0.09 * size, -0.05 * size), glm::dvec2(0.09 * size, 0.012 * size),
                       glm::dvec2(0.05 * size, 0.03 * size)},
            10);
  const auto face = [&](const glm::dmat4& turn, std::initializer_list<glm::dvec2> spots) {
    for (const glm::dvec2& at : spots) {
      append(made.pips, pip,
             moved({0, h, 0}) * turn * moved({0.24 * size * at.x, h, 0.24 * size * at.y}));
    }
  };
  face(glm::dmat4(1), {{-1, -1}, {1, 1}, {0, 0}, {-1, 1}, {1, -1}});
  face(turnedX(0.25), {{-1, -1}, {1, 1}, {0, 0}});
  face(turnedZ(-0.25), {{0, 0}});
  face(turnedX(-0.25), {{-1, -1}, {1, 1}, {-1, 1}, {1, -1}});
  face(turnedZ(0.25), {{-1, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, 0}, {1, 0}});
  return made;
}

}  // namespace grisaille::scene
