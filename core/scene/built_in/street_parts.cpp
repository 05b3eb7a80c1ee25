// SPDX-License-Identifier: MIT
#include "core/scene/built_in/street_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grisaille::scene {
namespace {

constexpr double kArch = 0.37, kAxle = 0.32;  // radius of a wheel arch, height of the axle

// The outline of a car from the side, and its plan.
class CarBody {
 public:
  CarBody(double length, bool van) : half_(length / 2), van_(van) {}

  double axle(double side) const { return side * 0.62 * half_; }

  Solid shell() const {
    std::vector<double> stations;
    for (int k = 0; k <= 12; ++k) stations.push_back(-half_ + half_ * k / 6);
    for (const double side : {-1.0, 1.0}) {
      for (const double t : {-1.0, -0.985, -0.8, -0.45, 0.0, 0.45, 0.8, 0.985, 1.0}) {
        stations.push_back(axle(side) + kArch * t);
      }
    }
    std::ranges::sort(stations);
    std::vector<Ring> rings;
    for (const double x : stations) {
      if (!rings.empty() && x - rings.back()[0].x < 0.004) continue;
      const double low = bottom(x), high = top(x), w = width(x);
      const double waist = std::max(0.52, low + 0.03);
      Ring& ring = rings.emplace_back();
      for (const glm::dvec2& p :
           {glm::dvec2(low, 0.9 * w), glm::dvec2(std::max(0.34, low + 0.01), 0.985 * w),
            glm::dvec2(waist, w), glm::dvec2(high - 0.1, 0.96 * w),
            glm::dvec2(high - 0.02, 0.88 * w), glm::dvec2(high, 0.7 * w)}) {
        ring.emplace_back(x, p.x, p.y);
      }
      for (size_t k = 6; k-- > 0;) ring.emplace_back(x, ring[k].y, -ring[k].z);
    }
    return loft(rings, false);
  }

  // The cabin: glass between the waist and the roof.
  Solid cabin() const {
    std::vector<Ring> rings;
    for (const glm::dvec2& p : outline()) {
      const double lean = 0.21 * (p.y - 0.8) / 0.6;
      Ring& ring = rings.emplace_back();
      ring = {{p.x, 0.7, 0.76},        {p.x, p.y - 0.03, 0.77 - lean}, {p.x, p.y, 0.73 - lean},
              {p.x, p.y, lean - 0.73}, {p.x, p.y - 0.03, lean - 0.77}, {p.x, 0.7, -0.76}};
    }
    return loft(rings, false);
  }

  // Points (along, height) of the cabin's centre line, from its front to its back.
  std::vector<glm::dvec2> outline() const {
    if (van_) {
      return {{0.78 * half_, 0.93}, {0.5 * half_, 1.62}, {0.42 * half_, 1.7}, {0.2 * half_, 1.74}};
    }
    return {{0.5 * half_, 0.85},  {0.17 * half_, 1.36},  {0.08 * half_, 1.4},
            {-0.3 * half_, 1.41}, {-0.42 * half_, 1.37}, {-0.76 * half_, 0.9}};
  }

 private:
  double bottom(double x) const {
    for (const double side : {-1.0, 1.0}) {
      const double away = (x - axle(side)) / kArch;
      if (std::abs(away) < 0.999) return kAxle + kArch * std::sqrt(1 - away * away);
    }
    return 0.2 + 0.12 * smoothUnit((std::abs(x) / half_ - 0.85) / 0.15);
  }
  double top(double x) const {
    const double t = x / half_, nose = smoothUnit((t - 0.86) / 0.14);
    if (van_) return 0.98 - 0.2 * nose - 0.02 * smoothUnit(t);
    const double tail = smoothUnit((-t - 0.9) / 0.1);
    return 0.92 - 0.08 * smoothUnit(t * 1.2) - 0.17 * nose - 0.1 * tail;
  }
  double width(double x) const {
    const double t = std::abs(x) / half_;
    return 0.87 - 0.1 * smoothUnit((t - 0.75) / 0.25) * (t - 0.5) * 2;
  }

  double half_;
  bool van_;
};

void addWheels(Car& car, const CarBody& body) {
  constexpr glm::dvec2 kTyre[] = {{0.24, -0.1}, {0.31, -0.085}, {0.315, 0.06},
                                  {0.29, 0.1},  {0.22, 0.105},  {0.2, 0.06}};
  constexpr glm::dvec2 kRim[] = {{0.21, 0.02},  {0.21, 0.085}, {0.18, 0.085},
                                 {0.165, 0.05}, {0.08, 0.06},  {0.06, 0.085}};
  const Solid tyre = lathe(kTyre, 14), rim = lathe(kRim, 10);
  for (const double side : {-1.0, 1.0}) {
    for (const double z : {-0.74, 0.74}) {
      const glm::dmat4 place = moved({body.axle(side), kAxle, z}) * turnedX(z > 0 ? 0.25 : -0.25);
      append(car.tyres, tyre, place);
      append(car.metal, rim, place);
    }
  }
}

// The sections are (towards +z, up) of a sweep along +x; turned so, it runs across the car.
void addBumpers(Car& car, double half) {
  constexpr glm::dvec2 kSection[] = {{-0.08, -0.09}, {0.03, -0.1}, {0.06, -0.05},
                                     {0.06, 0.06},   {0.03, 0.1},  {-0.08, 0.1}};
  for (const double side : {-1.0, 1.0}) {
    const Path front = {{-0.8, 0.42, -0.22}, {-0.74, 0.42, -0.06}, {-0.4, 0.42, 0.02},
                        {0.4, 0.42, 0.02},   {0.74, 0.42, -0.06},  {0.8, 0.42, -0.22}};
    const glm::dmat4 end = moved({side * (half - 0.03), 0, 0}) * turned(side > 0 ? 0.25 : -0.25);
    append(car.tyres, sweep(kSection, front, {0, 1, 0}), end);
    for (const double z : {-0.58, 0.58}) {
      append(car.metal, block({z - 0.14, 0.6, -0.3}, {z + 0.14, 0.72, 0.0}, 0.02), end);
    }
    append(car.metal, block({-0.26, 0.38, 0.05}, {0.26, 0.48, 0.095}, 0.004), end);
  }
}

void addVanBox(Car& car, double half) {
  std::vector<Ring> rings;
  for (const glm::dvec2& p :
       {glm::dvec2(0.28 * half, 1.68), glm::dvec2(0.22 * half, 1.86), glm::dvec2(0.1 * half, 1.95),
        glm::dvec2(-0.9 * half, 1.97), glm::dvec2(-0.97 * half, 1.9)}) {
    rings.push_back({{p.x, 0.75, 0.84},
                     {p.x, p.y - 0.3, 0.82},
                     {p.x, p.y - 0.06, 0.76},
                     {p.x, p.y, 0.68},
                     {p.x, p.y, -0.68},
                     {p.x, p.y - 0.06, -0.76},
                     {p.x, p.y - 0.3, -0.82},
                     {p.x, 0.75, -0.84}});
  }
  append(car.body, loft(rings, false));
  for (const double z : {-0.845, 0.845}) {
    append(car.metal, tube({{0.1 * half, 1.0, z}, {-0.9 * half, 1.0, z}}, 0.018, 8));
  }
}

}  // namespace

Car car(double length, bool van) {
  const CarBody body(length, van);
  const double half = length / 2;
  Car car;
  car.body = body.shell();
  car.glass = body.cabin();
  append(car.tyres, block({-0.92 * half, 0.17, -0.55}, {0.92 * half, 0.66, 0.55}, 0.05));
  addWheels(car, body);
  addBumpers(car, half);
  const std::vector<glm::dvec2> line = body.outline();
  for (const double side : {-1.0, 1.0}) {
    Path edge;
    for (const glm::dvec2& p : line)
      edge.emplace_back(p.x, p.y, side * (0.755 - 0.21 * (p.y - 0.8) / 0.6));
    append(car.body, tube(edge, 0.035, 7));
    const double pillar = van ? 0.34 * half : -0.12 * half, high = van ? 1.71 : 1.4;
    append(car.body, tube({{pillar, 0.85, side * 0.77},
                           {pillar - 0.02, high, side * (0.755 - 0.21 * (high - 0.8) / 0.6)}},
                          0.035, 7));
    append(car.body, block({0.36 * half - 0.05, 0.93, side * 0.93 - 0.09},
                           {0.36 * half + 0.05, 1.06, side * 0.93 + 0.09}, 0.02));
    append(car.body,
           tube({{0.36 * half, 0.9, side * 0.76}, {0.36 * half, 0.96, side * 0.9}}, 0.018, 6));
    append(car.metal, block({-0.02 * half - 0.1, 0.77, side * 0.845 - 0.02},
                            {-0.02 * half + 0.06, 0.8, side * 0.845 + 0.035}, 0.008));
  }
  const glm::dvec2 front = line[1], back = van ? line.back() : line[line.size() - 2];
  append(car.body, block({back.x - 0.03, front.y - 0.01, -0.55},
                         {front.x + 0.04, front.y + 0.075, 0.55}, 0.03));
  if (van) addVanBox(car, half);
  return car;
}

Solid lampPost(double height) {
  const double h = height;
  const std::array shaft{
      glm::dvec2(0.17, -0.1),     glm::dvec2(0.17, 0.12),     glm::dvec2(0.13, 0.16),
      glm::dvec2(0.12, 0.62),     glm::dvec2(0.145, 0.66),    glm::dvec2(0.145, 0.72),
      glm::dvec2(0.075, 0.8),     glm::dvec2(0.068, 1.5),     glm::dvec2(0.085, 1.53),
      glm::dvec2(0.085, 1.57),    glm::dvec2(0.062, 1.6),     glm::dvec2(0.05, h),
      glm::dvec2(0.07, h + 0.02), glm::dvec2(0.07, h + 0.06), glm::dvec2(0.02, h + 0.18)};
  Solid solid = lathe(shaft, 10);
  const Path arm = curve(std::array{glm::dvec3(0, h - 0.5, 0), glm::dvec3(0, h - 0.05, 0.28),
                                    glm::dvec3(0, h + 0.1, 0.7), glm::dvec3(0, h + 0.02, 1.05),
                                    glm::dvec3(0, h - 0.16, 1.12)},
                         3);
  append(solid, tube(arm, 0.026, 6));
  append(solid, tube(curve(std::array{glm::dvec3(0, h - 0.75, 0), glm::dvec3(0, h - 0.55, 0.3),
                                      glm::dvec3(0, h - 0.2, 0.3), glm::dvec3(0, h - 0.1, 0.12)},
                           3),
                     0.014, 5));
  const std::array lantern{glm::dvec2(0.03, -0.5),  glm::dvec2(0.1, -0.47),
                           glm::dvec2(0.21, -0.14), glm::dvec2(0.27, -0.12),
                           glm::dvec2(0.27, -0.08), glm::dvec2(0.12, 0.04),
                           glm::dvec2(0.05, 0.07),  glm::dvec2(0.04, 0.13)};
  append(solid, lathe(lantern, 8), moved({0, h - 0.24, 1.12}));
  return solid;
}

StreetBench streetBench(double length) {
  StreetBench bench;
  const double half = length / 2;
  for (int k = 0; k < 5; ++k) {
    append(bench.slats, box({-half, 0.43 - 0.003 * k * (4 - k), 0.2 - 0.098 * k - 0.04},
                            {half, 0.462 - 0.003 * k * (4 - k), 0.2 - 0.098 * k + 0.042}, 0.005));
  }
  for (int k = 0; k < 3; ++k) {
    append(bench.slats, box({-half, -0.045, -0.015}, {half, 0.045, 0.015}, 0.005),
           moved({0, 0.58 + 0.125 * k, -0.265 - 0.028 * k}) * turnedX(-0.03));
  }
  for (const double x : {-0.8 * half, 0.02, 0.8 * half}) {
    const auto iron = [&](std::initializer_list<glm::dvec3> points, double radius) {
      append(bench.irons, tube(curve(std::vector<glm::dvec3>(points), 2), radius, 5));
    };
    iron({{x, -0.02, 0.26},
          {x, 0.2, 0.21},
          {x, 0.4, 0.24},
          {x, 0.425, 0.1},
          {x, 0.425, -0.2},
          {x, 0.6, -0.29},
          {x, 0.88, -0.355}},
         0.018);
    iron({{x, -0.02, -0.36}, {x, 0.15, -0.26}, {x, 0.42, -0.2}}, 0.018);
    iron({{x, 0.12, 0.215}, {x, 0.2, 0.0}, {x, 0.14, -0.26}}, 0.012);
  }
  return bench;
}

Solid awning(double width, double reach, double drop) {
  return sheet(32, 4, [=](double u, double v) -> glm::dvec3 {
    const double x = (u - 0.5) * width;
    constexpr double kEdge = 0.8;  // the valance hangs beyond it
    const double t = std::min(v / kEdge, 1.0), below = std::max(v - kEdge, 0.0) / (1 - kEdge);
    const double scallop = 0.72 + 0.28 * std::abs(sinTurns(4 * u));
    const double wave = 0.02 * below * sinTurns(8 * u);
    return {x, -drop * t - 0.03 * sinTurns(t / 2) - 0.26 * below * scallop, reach * t + wave};
  });
}

Solid bollard() {
  constexpr glm::dvec2 kProfile[] = {{0.1, -0.2},   {0.1, 0.05},   {0.075, 0.09}, {0.065, 0.7},
                                     {0.085, 0.73}, {0.085, 0.77}, {0.06, 0.8},   {0.07, 0.86},
                                     {0.06, 0.92},  {0.02, 0.95}};
  return lathe(kProfile, 10);
}

Solid bin() {
  Solid solid =
      lathe(std::array{glm::dvec2(0.2, 0.06), glm::dvec2(0.22, 0.1), glm::dvec2(0.22, 0.8),
                       glm::dvec2(0.2, 0.8), glm::dvec2(0.19, 0.4)},
            14);
  for (int k = 0; k < 14; ++k) {
    append(solid, box({0.205, 0.05, -0.023}, {0.245, 0.84, 0.023}), turned(k / 14.0));
  }
  append(solid, torus(0.235, 0.02, 18, 6), moved({0, 0.85, 0}));
  append(solid, lathe(std::array{glm::dvec2(0.16, -0.1), glm::dvec2(0.15, 0.09)}, 12));
  return solid;
}

Solid bicycleStand() {
  Solid solid;
  for (int k = 0; k < 4; ++k) {
    const double x = 0.75 * k - 1.1;
    append(solid,
           tube(bent(Path{{x, -0.1, -0.38}, {x, 0.8, -0.38}, {x, 0.8, 0.38}, {x, -0.1, 0.38}}, 0.18,
                     4),
                0.024, 8));
  }
  return solid;
}

}  // namespace grisaille::scene
