// SPDX-License-Identifier: MIT
// A garden: trees, a hedge, grass, a fence.
#include <array>

#include "core/scene/built_in/assembly.h"
#include "core/scene/built_in/plants.h"
#include "core/scene/built_in/scenes.h"
#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {
namespace {

constexpr double kFenceZ = 2.2, kHedgeZ = -4.6;
constexpr glm::dvec2 kTrees[] = {{-2.4, -1.6}, {1.9, -0.7}, {4.6, -3.1}};

// Height of the ground: gentle mounds, higher at the hedge, and a rise round each trunk.
double groundAt(double x, double z) {
  double y = 0.16 * noise(x / 3.1, z / 3.1, 1) + 0.05 * noise(x / 0.9, z / 0.9, 2) +
             0.015 * noise(x / 0.3, z / 0.3, 3) + 0.25 * smoothUnit((-z - 2) / 5);
  for (const glm::dvec2& foot : kTrees) {
    const glm::dvec2 away = glm::dvec2(x, z) - foot;
    y += 0.12 * (1 - smoothUnit(glm::length(away) / 0.9));
  }
  return y;
}

glm::dvec3 onGround(double x, double z, double above = 0) {
  return {x, groundAt(x, z) + above, z};
}

class Leaves {
 public:
  Scene build() {
    addGround();
    addTrees();
    addFence();
    addGrass();
    addThings();
    return scene_.finish(
        {.eye = {-2.9, 1.62, 4.1}, .target = {-0.4, 1.45, -0.6}, .fovyDegrees = 60});
  }

 private:
  void addGround() {
    scene_.put(ground({-9, -8}, {9, 7.5}, {72, 62}, -0.8, groundAt), earth_, kCrease60);
    // Stepping stones from the fence to the trees.
    Solid stones;
    for (uint32_t k = 0; k < 9; ++k) {
      std::vector<glm::dvec2> outline;
      for (uint32_t i = 0; i < 9; ++i) {
        const double r = 0.22 * hashBetween(k * 16 + i, 0.8, 1.15), turn = i / 9.0;
        outline.emplace_back(1.25 * r * cosTurns(turn), r * sinTurns(turn));
      }
      const double z = 4.6 - 0.72 * k;
      const double x = 0.35 + 0.5 * sinTurns(0.1 * k) + hashBetween(k + 900, -0.06, 0.06);
      append(
          stones, prism(outline, -0.2, 0.035, 0.02),
          moved(onGround(x, z)) * turned(hashUnit(k)) * turnedX(hashBetween(k + 50, -0.01, 0.01)));
    }
    scene_.put(stones, stone_);
    Solid rocks;
    constexpr glm::dvec3 kRocks[] = {{-3.6, 1.3, 0.3},  {-3.1, 1.05, 0.17}, {2.6, 0.9, 0.24},
                                     {-0.9, -2.6, 0.4}, {-0.4, -2.2, 0.2},  {4.0, 1.3, 0.3}};
    for (const glm::dvec3& rock : kRocks) {  // x, z, radius
      Solid solid = ball(rock.z, 14, 9);
      for (glm::dvec3& p : solid.positions) {
        const glm::dvec3 q = 1.7 * p / rock.z + rock.x;
        p *= 1 + 0.22 * noise(q.x, q.y, 11) + 0.18 * noise(q.z, q.y + q.x, 12);
        p.y *= 0.7;
      }
      append(rocks, solid, moved(onGround(rock.x, rock.y, 0.25 * rock.z)));
    }
    scene_.put(rocks, stone_, kCrease60);
  }

  void putPlant(const Plant& plant, uint32_t foliage, const glm::dmat4& place) {
    scene_.place(scene_.add(plant.wood, bark_, kCrease75), place);
    scene_.place(scene_.add(plant.leaves, foliage, kNoCrease), place);
  }

  void addTrees() {
    const uint32_t twigs = scene_.foliage("twigs", twigTexture());
    const uint32_t sprays = scene_.foliage("hedge", hedgeTexture());
    const TreeForm forms[] = {
        {.height = 4.1, .radius = 0.12, .clear = 1.35, .branches = 9, .reach = 1.55},
        {.height = 3.2, .radius = 0.085, .clear = 1.0, .branches = 8, .reach = 1.15, .card = 0.26},
        {.height = 4.6, .radius = 0.14, .clear = 1.6, .branches = 9, .reach = 1.7, .card = 0.33}};
    for (uint32_t k = 0; k < std::size(forms); ++k) {
      putPlant(tree(forms[k], 21 + k), twigs, moved(onGround(kTrees[k].x, kTrees[k].y)));
    }
    for (uint32_t k = 0; k < 2; ++k) {
      const double x = k == 0 ? -3.4 : 3.3;
      putPlant(hedge({6.4, 1.35, 0.8}, 2300, 40 + k), sprays, moved(onGround(x, kHedgeZ)));
    }
  }

  void addFence() {
    constexpr int kPosts = 8;
    constexpr double kStep = 1.7;
    Solid fence;
    std::vector<glm::dvec3> feet;
    for (uint32_t k = 0; k < kPosts; ++k) {
      const double x = (k - (kPosts - 1) / 2.0) * kStep + hashBetween(k + 70, -0.05, 0.05);
      feet.push_back(onGround(x, kFenceZ + hashBetween(k + 90, -0.03, 0.03)));
      const glm::dmat4 lean = moved(feet.back()) * turnedX(hashBetween(k + 10, -0.008, 0.008)) *
                              turnedZ(hashBetween(k + 30, -0.01, 0.01)) *
                              turned(hashBetween(k + 50, -0.02, 0.02));
      append(fence, block({-0.055, -0.4, -0.055}, {0.055, 1.16, 0.055}, 0.008), lean);
      const std::array roof{glm::dvec2(0.052, 1.15), glm::dvec2(0.07, 1.155),
                            glm::dvec2(0.07, 1.18), glm::dvec2(0.012, 1.235)};
      append(fence, lathe(roof, 4), lean * turned(0.125));
    }
    // Rails overlap beside a post, one in front of the other, and run past it.
    constexpr glm::dvec2 kRail[] = {{-0.016, -0.042}, {0.016, -0.045}, {0.02, -0.04},
                                    {0.02, 0.04},     {0.016, 0.045},  {-0.016, 0.042}};
    for (uint32_t k = 0; k + 1 < kPosts; ++k) {
      for (uint32_t row = 0; row < 3; ++row) {
        const uint32_t seed = k * 8 + row;
        const auto end = [&](const glm::dvec3& foot, double past, uint32_t salt) {
          return foot + glm::dvec3(past, 0.3 + 0.34 * row + hashBetween(seed + salt, -0.02, 0.02),
                                   0.06 + 0.034 * ((k + row) % 2));
        };
        const glm::dvec3 from = end(feet[k], -0.09, 200), to = end(feet[k + 1], 0.09, 300);
        const glm::dvec3 bow(0, hashBetween(seed + 400, -0.015, 0.01), 0);
        append(fence,
               sweep(kRail, curve(std::array{from, 0.5 * (from + to) + bow, to}, 3), {0, 1, 0}));
      }
    }
    scene_.put(fence, wood_);
  }

  void addGrass() {
    constexpr uint32_t kKinds = 4;
    uint32_t tufts[kKinds];
    for (uint32_t k = 0; k < kKinds; ++k) {
      tufts[k] = scene_.add(grass(20, 0.2, 0.15 + 0.05 * k, 60 + k), blade_, kNoCrease);
    }
    for (uint32_t k = 0; k < 290; ++k) {
      const double near = hashUnit(k + 5000);
      const double x = hashBetween(k + 6000, -5.5, 5.5);
      // Dense along the fence, sparse elsewhere.
      const double z = near < 0.35 ? kFenceZ + hashBetween(k + 7000, -0.45, 0.4)
                                   : hashBetween(k + 7000, -3.2, 4.4);
      const bool path = std::abs(x - 0.6) < 0.45;
      const uint32_t kind = path ? 0 : near < 0.5 ? 1 + k % 3 : k % 3;
      scene_.place(tufts[kind], moved(onGround(x, z)) * turned(hashUnit(k + 8000)));
    }
  }

  void addThings() {
    // A pile of logs.
    Solid logs;
    constexpr glm::dvec3 kLogs[] = {{-0.34, 0.1, 0.15},  {0, 0.09, 0.16},     {0.33, 0.1, 0.14},
                                    {-0.17, 0.36, 0.15}, {0.17, 0.36, 0.135}, {0, 0.61, 0.14}};
    for (uint32_t k = 0; k < std::size(kLogs); ++k) {  // across, up, radius
      std::vector<Ring> rings;
      for (uint32_t i = 0; i <= 5; ++i) {
        Ring& ring = rings.emplace_back();
        for (uint32_t j = 0; j < 14; ++j) {
          const double turn = j / 14.0;
          const double r = kLogs[k].z * (1 + 0.1 * (hashUnit(k * 512 + i / 2 * 16 + j) - 0.5));
          ring.emplace_back(0.19 * i - 0.5, kLogs[k].y + r * sinTurns(turn),
                            kLogs[k].x + r * cosTurns(turn));
        }
      }
      append(logs, loft(rings, false), moved({hashBetween(k, -0.06, 0.06), 0, 0}));
    }
    scene_.place(scene_.add(logs, bark_, kCrease60), moved(onGround(-3.9, -0.2)) * turned(0.06));
    // A ladder against the first tree.
    Solid ladder;
    const glm::dvec3 foot = onGround(-1.55, -0.85, -0.02), top(-2.28, 2.95, -1.5);
    const glm::dvec3 side = 0.21 * glm::normalize(glm::cross(top - foot, glm::dvec3(0, 1, 0)));
    for (const double way : {-1.0, 1.0}) {
      append(ladder,
             tube({foot + way * side, top + 0.8 * way * side}, std::array{0.028, 0.022}, 8));
    }
    for (int k = 0; k < 9; ++k) {
      const glm::dvec3 middle = glm::mix(foot, top, 0.09 + 0.1 * k);
      const double reach = 1.04 - 0.02 * k;
      append(ladder, tube({middle - reach * side, middle + reach * side}, 0.014, 8));
    }
    scene_.put(ladder, wood_, kCrease60);
  }

  Assembly scene_{"leaves"};
  uint32_t earth_ = scene_.plain("earth", {0.2f, 0.2f, 0.1f});
  uint32_t stone_ = scene_.plain("stone", {0.46f, 0.45f, 0.42f});
  uint32_t bark_ = scene_.plain("bark", {0.33f, 0.25f, 0.18f});
  uint32_t wood_ = scene_.plain("weathered wood", {0.52f, 0.47f, 0.4f});
  uint32_t blade_ = scene_.cloth("grass", {0.25f, 0.4f, 0.12f});
};

}  // namespace

Scene makeLeaves() {
  return Leaves().build();
}

}  // namespace grisaille::scene
