// SPDX-License-Identifier: MIT
// The corner of a dining room.
#include <algorithm>
#include <array>

#include "core/scene/built_in/assembly.h"
#include "core/scene/built_in/atrium_parts.h"
#include "core/scene/built_in/furniture.h"
#include "core/scene/built_in/scenes.h"
#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {
namespace {

constexpr double kHalfRoom = 2, kCeiling = 2.6;  // half of the room's side, its height
constexpr double kTableTop = 0.745;              // height of the table

class Table {
 public:
  Scene build() {
    addRoom();
    addWindow();
    addTable();
    addChairs();
    addShelf();
    addTableware();
    addThings();
    return scene_.finish(
        {.eye = {1.72, 1.52, 1.85}, .target = {-0.42, 0.72, -0.75}, .fovyDegrees = 56});
  }

 private:
  void addRoom() {
    Solid floor = box({-kHalfRoom - 0.1, -0.2, -kHalfRoom - 0.1}, {kHalfRoom, -0.012, kHalfRoom});
    scene_.put(floor, dark_);
    Solid planks[2];
    constexpr double kPlank = 0.142;
    for (uint32_t row = 0; row < 29; ++row) {
      const double z = -kHalfRoom - 0.08 + kPlank * row;
      if (z + kPlank > kHalfRoom + 0.01) break;
      double x = -kHalfRoom - 0.09;
      for (uint32_t k = 0; x < kHalfRoom - 0.05; ++k) {
        const uint32_t seed = row * 16 + k;
        double end = std::min(x + hashBetween(seed, 0.9, 2.2), kHalfRoom - 0.01);
        if (kHalfRoom - end < 0.3) end = kHalfRoom - 0.01;
        append(planks[seed % 2],
               box({x, -0.05, z},
                   {end - 0.0015, -0.0012 * hashUnit(seed + 700), z + kPlank - 0.0015}, 0.0015));
        x = end;
      }
    }
    scene_.put(planks[0], oak_);
    scene_.put(planks[1], brown_);
    scene_.put(box({-kHalfRoom - 0.2, -0.15, -kHalfRoom - 0.2},
                   {kHalfRoom + 0.02, kCeiling + 0.1, -kHalfRoom}),
               wall_);
    scene_.put(box({-kHalfRoom - 0.19, kCeiling, -kHalfRoom - 0.19},
                   {kHalfRoom + 0.01, kCeiling + 0.2, kHalfRoom + 0.01}),
               wall_);
    Solid trim;
    // Skirting boards and a cornice, seen from their wall as (forwards, up).
    constexpr glm::dvec2 kSkirting[] = {{-0.02, -0.02}, {0.016, -0.02}, {0.016, 0.085},
                                        {0.012, 0.1},   {0.006, 0.108}, {-0.02, 0.108}};
    constexpr glm::dvec2 kCornice[] = {{-0.02, -0.09}, {0.008, -0.09}, {0.012, -0.075},
                                       {0.03, -0.06},  {0.055, -0.03}, {0.075, -0.015},
                                       {0.08, 0.02},   {-0.02, 0.02}};
    const Path back{{-kHalfRoom - 0.01, 0, -kHalfRoom}, {kHalfRoom + 0.015, 0, -kHalfRoom}};
    const Path left{{-kHalfRoom, 0.0005, kHalfRoom + 0.015},
                    {-kHalfRoom, 0.0005, -kHalfRoom - 0.012}};
    const auto at = [](const Path& path, double y) {
      Path moved = path;
      for (glm::dvec3& p : moved) p.y += y;
      return moved;
    };
    for (const Path& path : {back, left}) {
      append(trim, sweep(kSkirting, path, {0, 1, 0}));
      append(trim, sweep(kCornice, at(path, kCeiling), {0, 1, 0}));
    }
    scene_.put(trim, white_);
  }

  // The left wall with its window, a radiator and curtains.
  void addWindow() {
    const std::array xs{-kHalfRoom - 0.2, -1.0, 0.35, kHalfRoom + 0.2},
        ys{-0.14, 0.82, 2.2, kCeiling + 0.09};
    const Solid left = recessedWall(
        xs, ys, [](uint32_t i, uint32_t j) { return i == 1 && j == 1 ? 0.16 : 0.0; }, 0.3);
    const glm::dmat4 place = moved({-kHalfRoom, 0, 0}) * turned(0.25);  // +z to +x, +x to -z
    scene_.place(scene_.add(left, wall_), place);
    Solid sash;
    const auto bar = [&](double x0, double y0, double x1, double y1, double out) {
      append(sash, block({x0, y0, -0.18}, {x1, y1, -0.16 + out}, 0.004));
    };
    bar(-1.01, 0.81, -0.94, 2.21, 0.05);
    bar(0.29, 0.81, 0.36, 2.21, 0.05);
    bar(-1.0, 0.81, 0.35, 0.875, 0.052);
    bar(-1.0, 2.14, 0.35, 2.21, 0.052);
    bar(-0.36, 0.82, -0.29, 2.2, 0.045);
    bar(-0.99, 1.72, 0.34, 1.76, 0.035);
    append(sash, block({-1.05, 0.785, -0.2}, {0.4, 0.825, 0.07}, 0.008));
    scene_.place(scene_.add(sash, white_), place);
    scene_.place(scene_.add(radiator(1.1, 0.62), white_), place * moved({-0.3, 0, 0.01}));
    // The rod, with rings and two curtains.
    Solid rod = tube({{-1.42, 2.36, 0.11}, {0.77, 2.36, 0.11}}, 0.013, 12);
    for (const double x : {-1.44, 0.79}) append(rod, ball(0.024, 14, 10), moved({x, 2.36, 0.11}));
    for (const double x : {-1.3, 0.65})
      append(rod, tube(bent(Path{{x, 2.3, -0.02}, {x, 2.3, 0.11}, {x, 2.352, 0.11}}, 0.03, 4),
                       0.007, 8));
    const auto hang = [&](double x, double width, double drop, uint32_t folds) {
      scene_.place(scene_.add(curtain(width, drop, folds), cloth_, kNoCrease),
                   place * moved({x, 2.318, 0.11}));
      for (uint32_t k = 0; k <= folds; ++k) {
        append(rod, torus(0.021, 0.0022, 16, 6),
               moved({x + width * (static_cast<double>(k) / folds - 0.5), 2.346, 0.11}) *
                   turnedZ(0.25 + hashBetween(k, -0.02, 0.02)));
      }
    };
    hang(-1.12, 0.46, 2.28, 4);
    hang(0.47, 0.44, 2.275, 4);
    scene_.place(scene_.add(rod, brass_, kCrease60), place);
  }

  void addTable() {
    scene_.put(rug({2.5, 1.9}), wool_, kCrease60);
    scene_.place(scene_.add(diningTable({1.5, kTableTop, 0.85}), oak_), moved({0, 0.008, 0}));
    scene_.place(scene_.add(runner(0.75, 0.34, 0.2), linen_, kNoCrease),
                 moved({0, kTableTop + 0.0085, 0.02}));
  }

  void addChairs() {
    const uint32_t seat = scene_.add(chair(), brown_);
    const auto stand = [&](double x, double z, double turn) {
      scene_.place(seat, moved({x, 0.0075, z}) * turned(turn));
    };
    stand(-0.36, -0.52, 0.012);
    stand(0.42, -0.6, -0.03);
    stand(-0.3, 0.55, 0.49);
    stand(0.5, 0.82, 0.56);
    scene_.place(seat, moved({-1.12, 0.0075, 0.05}) * turned(0.27));
  }

  void addShelf() {
    const glm::dmat4 place = moved({1.02, 0, -kHalfRoom + 0.02});
    constexpr uint32_t kBoards = 6;
    scene_.place(scene_.add(shelf({1.0, 2.0, 0.29}, kBoards), oak_), place);
    Solid books[4];
    for (uint32_t row = 0; row + 1 < kBoards; ++row) {
      const double y = 0.07 + 1.91 * row / (kBoards - 1) + 0.0113;
      double x = -0.475;
      const double end = row == 1 ? 0.12 : row == 3 ? 0.2 : row == 4 ? -0.05 : 0.4;
      for (uint32_t k = 0; x < end; ++k) {
        const uint32_t seed = row * 64 + k;
        const glm::dvec3 size(hashBetween(seed, 0.014, 0.046),
                              hashBetween(seed + 1000, 0.19, 0.285),
                              hashBetween(seed + 2000, 0.14, 0.2));
        const bool leans = hashUnit(seed + 3000) < 0.12 && k > 1;
        const double lean = leans ? hashBetween(seed, 0.012, 0.026) : 0;
        if (leans) x += 0.05;
        const glm::dmat4 stand = moved({x + size.x / 2 + 0.002, y + 0.5 * size.x * sinTurns(lean),
                                        0.225 + hashBetween(seed + 4000, -0.025, 0.02)}) *
                                 turnedZ(lean);
        append(books[seed * 7 % 4], book(size), place * stand);
        x += size.x + 0.003 + (leans ? 0.004 : 0);
      }
    }
    // A pile that lies, on the third shelf from below.
    double y = 0.07 + 1.91 * 3 / (kBoards - 1) + 0.0115;
    for (uint32_t k = 0; k < 4; ++k) {
      const glm::dvec3 size(0.022 + 0.007 * k, 0.25 - 0.02 * k, 0.18 - 0.012 * k);
      append(books[k], book(size),
             place * moved({0.46, y + size.x / 2, 0.24}) * turned(hashBetween(k, -0.01, 0.012)) *
                 turnedZ(0.25));
      y += size.x + 0.0015;
    }
    for (uint32_t k = 0; k < 4; ++k) scene_.put(books[k], covers_[k]);
    const auto at = [&](double x, uint32_t row) {
      return place * moved({x, 0.0812 + 1.91 * row / (kBoards - 1), 0.15});
    };
    scene_.place(scene_.add(vase(0.27), clay_, kCrease60), at(0.3, 1));
    scene_.place(scene_.add(crate({0.3, 0.16, 0.22}, 0.008), brown_), at(0.28, 4));
    scene_.place(scene_.add(bowl(0.1, 0.07), white_, kCrease60),
                 at(0.06, 4) * moved({0, 0.0005, 0.02}));
  }

  void addTableware() {
    const auto on = [](double x, double z, double turn = 0) {
      return moved({x, kTableTop + 0.0088, z}) * turned(turn);
    };
    scene_.place(scene_.add(bowl(0.15, 0.085), white_, kCrease60),
                 on(0.02, 0.01) * moved({0, 0.002, 0}));
    Solid fruits;
    constexpr glm::dvec4 kFruits[] = {{-0.055, 0.05, -0.02, 0.037},
                                      {0.045, 0.049, -0.045, 0.036},
                                      {0.03, 0.05, 0.05, 0.038},
                                      {-0.035, 0.052, 0.062, 0.033},
                                      {0.005, 0.102, 0.01, 0.036}};
    for (uint32_t k = 0; k < std::size(kFruits); ++k) {
      append(fruits, fruit(kFruits[k].w, k),
             on(0.02, 0.01) * moved(glm::dvec3(kFruits[k]) + glm::dvec3(0, 0.002, 0)) *
                 turned(0.21 * k) * turnedZ(0.03 * k));
    }
    scene_.put(fruits, red_, kCrease60);
    const uint32_t cups = scene_.add(cup(), white_, kCrease60),
                   saucers = scene_.add(saucer(0.075), white_, kCrease60);
    const uint32_t plates = scene_.add(saucer(0.125), white_, kCrease60);
    for (const glm::dvec3& p : {glm::dvec3(-0.36, -0.28, 0.1), glm::dvec3(0.41, -0.27, 0.62),
                                glm::dvec3(-0.31, 0.29, 0.35), glm::dvec3(0.47, 0.3, 0.9)}) {
      const bool empty = p.x > 0.45;
      const glm::dmat4 place = on(p.x + (empty ? 0.13 : 0.0), p.y, p.z);
      scene_.place(saucers, place);
      scene_.place(cups, place * moved({0, 0.0066, 0}));
    }
    for (int k = 0; k < 4; ++k)
      scene_.place(plates, on(0.52 + 0.003 * (k % 2), -0.02 + 0.002 * k) *
                               moved({0, 0.0012 + 0.0064 * k, 0}));
    scene_.place(scene_.add(bottle(0.29), clay_, kCrease60), on(-0.24, -0.12));
    const uint32_t stick = scene_.add(candlestick(0.3), brass_, kCrease60);
    scene_.place(stick, on(-0.27, 0.06) * moved({0, 0.0005, 0}));
    scene_.place(scene_.add(candlestick(0.24), brass_, kCrease60),
                 on(-0.38, 0.02) * moved({0, 0.002, 0}));
    // Spoons on the saucers, a napkin ring, an open book.
    Solid spoons;
    for (const glm::dvec3& p : {glm::dvec3(-0.36, -0.28, 0.4), glm::dvec3(-0.31, 0.29, 0.6)}) {
      const glm::dmat4 place = on(p.x, p.y, p.z) * moved({0, 0.017, 0.052});
      append(spoons,
             tube({{-0.05, 0.006, 0}, {-0.02, 0.003, 0.004}, {0.03, 0.0025, 0.006}},
                  std::array{0.003, 0.0016, 0.002}, 7),
             place);
      Solid leaf = ball(0.013, 14, 9);
      append(spoons, leaf, place * moved({0.042, 0.004, 0.006}) * scaled({1.25, 0.28, 0.85}));
    }
    scene_.put(spoons, brass_, kCrease60);
    scene_.place(scene_.add(book({0.03, 0.24, 0.17}), covers_[2]),
                 on(-0.56, 0.02, 0.05) * moved({0.1, 0.0175, 0.08}) * turnedZ(0.25));
  }

  void addThings() {
    const HangingLamp lamp = hangingLamp(0.92, 0.24);
    scene_.place(scene_.add(lamp.shade, red_, kCrease35), moved({0.02, kCeiling, 0.02}));
    scene_.place(scene_.add(lamp.cord, brass_, kCrease60), moved({0.02, kCeiling, 0.02}));
    // A framed picture on the back wall.
    Solid picture = box({-0.36, -0.27, -0.01}, {0.36, 0.27, 0.008});
    const glm::dmat4 hung = moved({-0.55, 1.62, -kHalfRoom}) * turnedZ(0.003);
    scene_.place(scene_.add(picture, white_), hung);
    constexpr glm::dvec2 kMoulding[] = {{0, -0.005},    {0, 0.02},      {0.008, 0.03},
                                        {0.02, 0.032},  {0.03, 0.022},  {0.042, 0.018},
                                        {0.048, 0.012}, {0.048, -0.005}};
    scene_.place(scene_.add(frame(kMoulding, {0.385, 0.295}), brass_), hung * turnedX(0.25));
    // A plant in the corner, a basket with balls, wooden bricks on the rug.
    const glm::dmat4 corner = moved({-1.62, 0.0005, -1.6});
    scene_.place(scene_.add(pot(0.17), clay_, kCrease60), corner);
    scene_.place(scene_.add(lathe(std::array{glm::dvec2(0.12, 0.18), glm::dvec2(0.14, 0.205),
                                             glm::dvec2(0.06, 0.215)},
                                  20),
                            dark_, kCrease60),
                 corner);
    const uint32_t leaf = scene_.foliage("leaf", leafTexture());
    scene_.place(scene_.add(plant(20, 0.62, 5), leaf, kNoCrease), corner * moved({0, 0.205, 0}));
    const glm::dmat4 basket = moved({-0.62, 0.0005, -1.66}) * turned(0.03);
    scene_.place(scene_.add(crate({0.46, 0.3, 0.34}, 0.012), oak_), basket);
    Solid balls;
    append(balls, ball(0.11, 22, 15), basket * moved({-0.08, 0.128, 0.02}));
    append(balls, ball(0.085, 22, 15), basket * moved({0.11, 0.11, -0.04}));
    append(balls, ball(0.07, 20, 13), basket * moved({0.05, 0.235, 0.04}));
    append(balls, ball(0.105, 24, 16), moved({1.22, 0.104, 0.62}));
    scene_.put(balls, red_, kNoCrease);
    Solid bricks;
    for (uint32_t k = 0; k < 9; ++k) {
      const double x = 0.95 + 0.075 * (k % 4) + hashBetween(k, -0.012, 0.012),
                   z = 0.05 + 0.08 * (k / 4 % 2) + hashBetween(k + 9, -0.01, 0.01);
      const double y = k == 8 ? 0.0555 : 0.0065;
      append(bricks, block({-0.024, 0, -0.024}, {0.024, 0.048, 0.024}, 0.003),
             moved({x, y, z}) * turned(hashBetween(k + 20, -0.08, 0.08)));
    }
    scene_.put(bricks, oak_);
  }

  Assembly scene_{"table"};
  uint32_t wall_ = scene_.plain("wall", {0.7f, 0.66f, 0.58f});
  uint32_t white_ = scene_.plain("white", {0.78f, 0.77f, 0.74f});
  uint32_t oak_ = scene_.plain("oak", {0.52f, 0.36f, 0.2f});
  uint32_t brown_ = scene_.plain("brown wood", {0.36f, 0.22f, 0.12f});
  uint32_t dark_ = scene_.plain("dark", {0.1f, 0.08f, 0.06f});
  uint32_t brass_ = scene_.plain("brass", {0.55f, 0.42f, 0.18f});
  uint32_t clay_ = scene_.plain("clay", {0.5f, 0.24f, 0.15f});
  uint32_t red_ = scene_.plain("red", {0.55f, 0.1f, 0.06f});
  uint32_t covers_[4] = {scene_.plain("green book", {0.13f, 0.26f, 0.17f}),
                         scene_.plain("red book", {0.45f, 0.12f, 0.1f}),
                         scene_.plain("blue book", {0.14f, 0.2f, 0.36f}),
                         scene_.plain("sand book", {0.62f, 0.52f, 0.36f})};
  uint32_t wool_ = scene_.plain("wool", {0.42f, 0.2f, 0.16f});
  uint32_t cloth_ = scene_.cloth("blue cloth", {0.2f, 0.28f, 0.4f});
  uint32_t linen_ = scene_.cloth("linen", {0.72f, 0.68f, 0.58f});
};

}  // namespace

Scene makeTable() {
  return Table().build();
}

}  // namespace grisaille::scene
