// SPDX-License-Identifier: MIT
// A walkway of steel grating in a plant room, with machines on it, below it and beside it.
#include <array>

#include "core/scene/built_in/assembly.h"
#include "core/scene/built_in/machine_parts.h"
#include "core/scene/built_in/scenes.h"
#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {
namespace {

constexpr double kDeck = 1.3;                       // height of the walkway
constexpr double kHalfWidth = 0.45, kPanel = 1.15;  // of a panel of the walkway
constexpr int kPanels = 4;
constexpr double kDeckEnd = kPanels * kPanel / 2;
constexpr double kRearWall = -2.3;  // z of the wall

class Grating {
 public:
  Scene build() {
    addRoom();
    addDeck();
    addRails();
    addMachine();
    addBelow();
    addPipes();
    addCables();
    return scene_.finish(
        {.eye = {-1.7, 2.72, 0.24}, .target = {0.75, 1.5, -0.22}, .fovyDegrees = 60});
  }

 private:
  void addRoom() {
    Solid floor;
    constexpr double kTile = 1.6, kJoint = 0.006;
    for (int i = -3; i < 3; ++i) {
      for (int j = -2; j < 3; ++j) {
        const auto seed = static_cast<uint32_t>(16 * (i + 8) + j + 8);
        append(floor,
               box({i * kTile + kJoint, -0.2, j * kTile + kJoint},
                   {(i + 1) * kTile - kJoint, -0.004 * hashUnit(seed), (j + 1) * kTile - kJoint},
                   0.008));
      }
    }
    append(floor, box({-4.85, -0.3, -3.25}, {4.85, -0.03, 4.85}));
    scene_.put(floor, concrete_);
    // The wall: panels of concrete with a recess each, above a plinth.
    const std::array xs{-4.8, -4.6, -3.1, -2.9, -1.3, -1.1, 0.5, 0.7, 2.3, 2.5, 4.0, 4.8};
    const std::array ys{-0.1, 0.35, 1.9, 2.05, 3.3, 3.5};
    Solid wall = recessedWall(
        xs, ys,
        [](uint32_t i, uint32_t j) { return i % 2 == 1 && j % 2 == 1 && i < 11 ? 0.03 : 0.0; },
        0.3);
    append(wall, box({-4.7, -0.15, -0.1}, {4.7, 0.14, 0.06}, 0.015));
    const uint32_t panels = scene_.add(wall, concrete_);
    scene_.place(panels, moved({0, 0, kRearWall}));
    scene_.place(panels, moved({4.2, 0.003, 2.35}) * turned(0.75));
  }

  void addDeck() {
    const uint32_t panel =
        scene_.add(gratingPanel({kPanel - 0.008, 2 * kHalfWidth}, 0.0345, 0.03), zinc_);
    for (int k = 0; k < kPanels; ++k) {
      const double x = (k + 0.5) * kPanel - kDeckEnd;
      scene_.place(panel, moved({x, kDeck - 0.002 * hashUnit(static_cast<uint32_t>(k)), 0}));
    }
    const uint32_t beam = scene_.add(iBeam(2 * kDeckEnd + 0.3, 0.16, 0.09), steel_);
    const uint32_t cross = scene_.add(iBeam(2 * kHalfWidth - 0.1, 0.1, 0.06), steel_);
    Solid leg = box({-0.035, 0.01, -0.035}, {0.035, kDeck - 0.17, 0.035});
    append(leg, box({-0.1, 0, -0.1}, {0.1, 0.012, 0.1}, 0.002));
    append(leg, box({-0.06, kDeck - 0.205, -0.045}, {0.06, kDeck - 0.185, 0.045}));
    for (const double x : {-0.07, 0.07}) {
      for (const double z : {-0.07, 0.07}) append(leg, bolt(0.012), moved({x, 0.012, z}));
    }
    const uint32_t column = scene_.add(leg, steel_);
    for (const double z : {-0.4, 0.4}) {
      scene_.place(beam, moved({0, kDeck - 0.031, z}));
      for (const double x : {-2.0, 0.0, 2.0}) scene_.place(column, moved({x, 0, z}));
    }
    for (int k = 0; k <= kPanels; ++k) {
      scene_.place(cross, moved({k * kPanel - kDeckEnd, kDeck - 0.034, 0}) * turned(0.25));
    }
  }

  // Handrails on both sides. The one towards the machine has a gap at its far end.
  void addRails() {
    Solid post = tube({{0, -0.06, 0}, {0, 1.1, 0}}, 0.02, 14);
    append(post, box({-0.05, 0, -0.004}, {0.05, 0.01, 0.075}, 0.002), moved({0, -0.052, -0.03}));
    append(post, lathe(std::array{glm::dvec2(0.026, 0.5), glm::dvec2(0.03, 0.52),
                                  glm::dvec2(0.03, 0.58), glm::dvec2(0.026, 0.6)},
                       14));
    append(post, lathe(std::array{glm::dvec2(0.026, 1.06), glm::dvec2(0.031, 1.075),
                                  glm::dvec2(0.026, 1.09)},
                       14));
    for (const double x : {-0.035, 0.035}) append(post, bolt(0.008), moved({x, -0.042, 0.025}));
    const uint32_t standing = scene_.add(post, yellow_, kCrease60);
    Solid rails, toes;
    for (const double side : {-1.0, 1.0}) {
      const double z = side * (kHalfWidth + 0.035), end = side < 0 ? 1.0 : kDeckEnd + 0.05;
      const double start = -kDeckEnd - 0.05;
      const int posts = side < 0 ? 4 : 5;
      for (int k = 0; k < posts; ++k) {
        const double x = start + 0.12 + (end - start - 0.24) * k / (posts - 1);
        scene_.place(standing, moved({x, kDeck, z}) * turned(side < 0 ? 0 : 0.5));
      }
      const double top = kDeck + 1.1, knee = kDeck + 0.55;
      append(rails, tube(bent(Path{{start + 0.12, knee, z},
                                   {start - 0.06, knee, z},
                                   {start - 0.06, top, z},
                                   {end + 0.06, top, z},
                                   {end + 0.06, knee, z},
                                   {end - 0.12, knee, z}},
                              0.09, 6),
                         0.02, 14));
      append(rails,
             tube({{start + 0.1, knee - 0.001, z}, {end - 0.1, knee - 0.001, z}}, 0.0135, 12));
      append(toes, box({start + 0.05, kDeck + 0.006, z - side * 0.035 - 0.003},
                       {end - 0.05, kDeck + 0.1, z - side * 0.035 + 0.003}));
    }
    scene_.put(rails, yellow_, kCrease60);
    scene_.put(toes, yellow_);
  }

  // A motor and a gear on a base frame, at the far end of the walkway.
  void addMachine() {
    const glm::dmat4 stand = moved({1.5, kDeck + 0.004, -0.1}) * turned(0.01);
    Solid base;
    for (const double z : {-0.17, 0.17}) {
      append(base, box({-0.62, 0, z - 0.03}, {0.72, 0.008, z + 0.03}));
      append(base, box({-0.62, 0.004, z - 0.004}, {0.72, 0.07, z + 0.004}));
      append(base, box({-0.62, 0.066, z - 0.031}, {0.72, 0.074, z + 0.031}));
    }
    for (const double x : {-0.56, -0.1, 0.2, 0.66}) {
      append(base, box({x - 0.03, 0.02, -0.2}, {x + 0.03, 0.064, 0.2}));
    }
    scene_.place(scene_.add(base, steel_), stand);
    const glm::dmat4 deck = stand * moved({0, 0.073, 0});
    scene_.place(scene_.add(motor(0.2), blue_), deck * moved({-0.34, 0, 0}));
    scene_.place(scene_.add(gearCase(0.2), grey_), deck * moved({0.42, 0, 0}));
    // The coupling, under a guard of bent sheet with a mesh of slots.
    Solid coupling;
    for (const double x : {-0.018, 0.018}) {
      const glm::dmat4 half = deck * moved({0.06 + x, 0.2, 0}) * turnedZ(-0.25);
      append(coupling,
             lathe(std::array{glm::dvec2(0.055, -0.014), glm::dvec2(0.06, -0.01),
                              glm::dvec2(0.06, 0.01), glm::dvec2(0.055, 0.014)},
                   20),
             half);
    }
    for (int k = 0; k < 7; ++k) {
      append(coupling,
             hoop(bent(Path{{0, 0.02, 0.001},
                            {0, 0.02, 0.11},
                            {0, 0.29, 0.11},
                            {0, 0.29, -0.11},
                            {0, 0.02, -0.11},
                            {0, 0.02, -0.001}},
                       0.06, 4),
                  0.003, 6),
             deck * moved({-0.02 + 0.0265 * k, 0, 0}));
    }
    scene_.put(coupling, yellow_);
  }

  void addBelow() {
    scene_.place(scene_.add(tank(2.3, 0.38, 0.56), grey_), moved({0.2, 0, -0.2}));
    scene_.place(scene_.add(drum(0.88), blue_, kCrease35),
                 moved({-1.75, -0.003, 1.05}) * turned(0.3));
    scene_.place(scene_.add(drum(0.87), yellow_, kCrease35),
                 moved({2.75, -0.003, 0.25}) * turned(0.1));
    // A pump beside the tank: a motor that drives a round casing.
    const glm::dmat4 stand = moved({-0.35, 0, 0.95}) * turned(-0.02);
    Solid pump = box({-0.75, -0.01, -0.22}, {0.45, 0.12, 0.22}, 0.012);
    const glm::dmat4 axis = moved({0.28, 0.32, 0}) * turnedZ(-0.25);
    append(
        pump,
        lathe(std::array{glm::dvec2(0.05, -0.16), glm::dvec2(0.09, -0.07), glm::dvec2(0.17, -0.06),
                         glm::dvec2(0.185, -0.04), glm::dvec2(0.185, 0.04), glm::dvec2(0.17, 0.06),
                         glm::dvec2(0.08, 0.075), glm::dvec2(0.06, 0.14)},
              32),
        axis);
    append(pump, boltCircle(0.15, 0.009, 10), axis * moved({0, 0.066, 0}));
    append(pump, box({0.22, 0.1, -0.07}, {0.34, 0.2, 0.07}));
    append(pump, pipe({{0.28, 0.45, 0.05}, {0.28, 0.72, 0.05}}, 0.046, false));
    append(pump, flangePair(0.05), moved({0.28, 0.6, 0.05}));
    append(pump, pipe({{0.4, 0.32, 0}, {0.75, 0.32, 0}}, 0.06, false));
    append(pump, flangePair(0.06), moved({0.5, 0.32, 0}) * turnedZ(0.25));
    scene_.place(scene_.add(pump, grey_), stand);
    scene_.place(scene_.add(motor(0.2), blue_), stand * moved({-0.3, 0.119, 0}));
    // The pump lifts into a pipe under the walkway.
    const glm::dvec3 lift(stand * glm::dvec4(0.28, 0.7, 0.05, 1));
    Solid riser = pipe(
        {lift, {lift.x, 1.02, lift.z}, {1.5, 1.02, lift.z}, {1.5, 1.02, 0.24}, {1.5, 0.4, 0.24}},
        0.05, false);
    append(riser, valve(0.05), moved({0.55, 1.02, lift.z}) * turnedZ(0.25));
    scene_.put(riser, red_, kCrease60);
  }

  // Pipes along the wall, with valves, and a manifold that rises to the machine.
  void addPipes() {
    Solid pipes, brackets;
    for (int k = 0; k < 3; ++k) {
      const double y = 0.55 + 0.36 * k, r = 0.062 - 0.012 * k, z = kRearWall + 0.22;
      append(pipes, tube({{-4.5, y, z}, {4.5, y, z}}, r, 16));
      for (const double x : {-2.7, 1.2}) {
        append(pipes, flangePair(r), moved({x + 0.31 * k, y, z}) * turnedZ(0.25));
      }
      const double x = -1.6 + 1.15 * k;
      append(pipes, pipe({{x, y, z},
                          {x, y, z + 0.3 - 0.03 * k},
                          {x, 2.9, z + 0.3 - 0.03 * k},
                          {x, 2.9, kRearWall - 0.1}},
                         0.75 * r, false));
      append(pipes, valve(0.75 * r), moved({x, 1.75 + 0.16 * k, z + 0.3 - 0.03 * k}));
    }
    for (const double x : {-3.8, -2.2, 0.15, 2.1, 4.0}) {
      append(brackets,
             box({x - 0.025, 0.3, kRearWall - 0.04}, {x + 0.025, 1.5, kRearWall + 0.045}));
      for (int k = 0; k < 3; ++k) {
        const double y = 0.55 + 0.36 * k, r = 0.062 - 0.012 * k;
        append(brackets, box({x - 0.02, y - r - 0.03, kRearWall + 0.02},
                             {x + 0.02, y - r - 0.004, kRearWall + 0.32}));
        append(brackets, tube(bent(Path{{x, y - r - 0.02, kRearWall + 0.22 - r - 0.006},
                                        {x, y + r + 0.006, kRearWall + 0.22 - r - 0.006},
                                        {x, y + r + 0.006, kRearWall + 0.22 + r + 0.006},
                                        {x, y - r - 0.02, kRearWall + 0.22 + r + 0.006}},
                                   0.9 * r, 4),
                              0.005, 6));
      }
    }
    scene_.put(pipes, zinc_, kCrease60);
    scene_.put(brackets, steel_);
    scene_.place(scene_.add(cabinet({0.7, 1.0, 0.25}), grey_), moved({1.75, 1.75, kRearWall}));
    scene_.place(scene_.add(cabinet({0.42, 0.6, 0.2}), grey_), moved({2.55, 2.0, kRearWall}));
  }

  void addCables() {
    Solid cables;
    for (uint32_t k = 0; k < 4; ++k) {
      const double x = 1.55 + 0.1 * k, sway = hashBetween(k, -0.06, 0.06);
      const double r = 0.008 + 0.002 * (k % 3);
      const std::array way{glm::dvec3(x, 1.78, kRearWall + 0.12),
                           glm::dvec3(x + 0.3 * sway, 1.62, kRearWall + 0.13),
                           glm::dvec3(x - 0.1 + sway, 1.22, kRearWall + 0.45),
                           glm::dvec3(x - 0.25 + sway, 0.98 - 0.03 * k, -1.3),
                           glm::dvec3(1.2 - 0.1 * k, 1.02, -0.62 - 0.03 * k),
                           glm::dvec3(0.1 - 0.3 * k, 1.0 + sway, -0.52 - 0.02 * k),
                           glm::dvec3(-1.2 - 0.3 * k, 1.04 - sway, -0.53 - 0.02 * k),
                           glm::dvec3(-2.5 - 0.3 * k, 0.6, -0.7)};
      append(cables, tube(curve(way, 6), r, 6));
    }
    // To the terminal boxes of the two motors.
    append(cables,
           tube(curve(std::array{glm::dvec3(1.16, 1.66, -0.17), glm::dvec3(1.15, 1.63, -0.3),
                                 glm::dvec3(1.13, 1.5, -0.45), glm::dvec3(1.12, 1.33, -0.545),
                                 glm::dvec3(1.13, 1.1, -0.56), glm::dvec3(1.2, 1.03, -0.65)},
                      8),
                0.009, 9));
    append(cables,
           tube(curve(std::array{glm::dvec3(-0.64, 0.47, 0.96), glm::dvec3(-0.7, 0.49, 1.05),
                                 glm::dvec3(-0.85, 0.3, 1.2), glm::dvec3(-1.1, 0.03, 1.1),
                                 glm::dvec3(-1.5, 0.012, 0.6), glm::dvec3(-2.0, 0.015, 0.1),
                                 glm::dvec3(-2.1, 0.3, -0.3), glm::dvec3(-2.0, 0.9, -0.52)},
                      8),
                0.01, 9));
    scene_.put(cables, rubber_, kCrease60);
  }

  Assembly scene_{"grating"};
  uint32_t concrete_ = scene_.plain("concrete", {0.5f, 0.49f, 0.46f});
  uint32_t zinc_ = scene_.plain("galvanised steel", {0.58f, 0.6f, 0.61f});
  uint32_t steel_ = scene_.plain("grey steel", {0.3f, 0.32f, 0.34f});
  uint32_t yellow_ = scene_.plain("yellow steel", {0.72f, 0.52f, 0.06f});
  uint32_t blue_ = scene_.plain("blue cast iron", {0.08f, 0.2f, 0.42f});
  uint32_t grey_ = scene_.plain("grey cast iron", {0.42f, 0.46f, 0.45f});
  uint32_t red_ = scene_.plain("red pipe", {0.5f, 0.08f, 0.06f});
  uint32_t rubber_ = scene_.plain("rubber", {0.05f, 0.05f, 0.055f});
};

}  // namespace

Scene makeGrating() {
  return Grating().build();
}

}  // namespace grisaille::scene
