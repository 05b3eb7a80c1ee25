// SPDX-License-Identifier: MIT
// A carved board on a desk, with chessmen and other small things before it.
#include <array>
#include <cmath>

#include "core/scene/built_in/assembly.h"
#include "core/scene/built_in/carvings.h"
#include "core/scene/built_in/scenes.h"
#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {
namespace {

constexpr double kBoardX = 0.2, kBoardZ = 0.135;  // half of the board's width and height

class Carving {
 public:
  Scene build() {
    addDesk();
    addBoard();
    addRelief();
    addChessmen();
    addThings();
    addSewing();
    return scene_.finish({.eye = {0.13, 0.165, 0.345},
                          .target = {-0.012, 0.07, -0.04},
                          .fovyDegrees = 42,
                          .nearPlane = 0.004});
  }

 private:
  void addDesk() {
    Solid desk;
    for (int k = 0; k < 5; ++k) {
      const double z = -0.36 + 0.15 * k;
      append(desk, box({-0.6, -0.03, z + 0.0006},
                       {0.6, -0.0004 * hashUnit(static_cast<uint32_t>(k)), z + 0.1494}, 0.0012));
    }
    append(desk, box({-0.61, -0.04, -0.37}, {0.61, -0.006, 0.4}));
    scene_.put(desk, walnut_);
    // The block that the board leans on.
    scene_.put(block({-0.05, -0.001, -0.26}, {0.05, 0.11, -0.19}, 0.003), walnut_);
  }

  // The relief lies on y = 0 of this frame; -z is the upper edge of the board.
  static glm::dmat4 board() { return moved({0, 0.1347, -0.127}) * turnedX(0.21) * turned(0.002); }

  void addBoard() {
    Solid wood = block({-kBoardX, -0.018, -kBoardZ}, {kBoardX, 0, kBoardZ}, 0.0015);
    constexpr glm::dvec2 kMoulding[] = {
        {-0.001, -0.004}, {-0.001, 0.006}, {0.001, 0.008},  {0.005, 0.0085}, {0.009, 0.0078},
        {0.012, 0.006},   {0.0135, 0.004}, {0.0145, 0.004}, {0.016, 0.0055}, {0.0185, 0.006},
        {0.021, 0.005},   {0.0225, 0.003}, {0.0235, 0.001}, {0.0235, -0.004}};
    append(wood, frame(kMoulding, {kBoardX - 0.002, kBoardZ - 0.002}));
    // An inner panel with a round edge.
    constexpr glm::dvec2 kPanel[] = {{0, -0.003},    {0, 0.0015},     {0.0012, 0.0026},
                                     {0.003, 0.003}, {0.005, 0.0026}, {0.006, 0.0012},
                                     {0.006, -0.003}};
    append(wood, frame(kPanel, {kBoardX - 0.038, kBoardZ - 0.038}));
    scene_.place(scene_.add(wood, oak_), board());
    // Beads between the two.
    Solid beads;
    const Solid bead = lathe(std::array{glm::dvec2(0.0031, -0.001), glm::dvec2(0.003, 0.0008),
                                        glm::dvec2(0.0022, 0.0022), glm::dvec2(0.0009, 0.003)},
                             8);
    const glm::dvec2 half(kBoardX - 0.0315, kBoardZ - 0.0315);
    const auto row = [&](const glm::dvec2& from, const glm::dvec2& to) {
      const auto count = static_cast<int>(std::lround(glm::length(to - from) / 0.0093));
      for (int k = 0; k < count; ++k) {
        const glm::dvec2 at = from + (to - from) * (static_cast<double>(k) / count);
        append(beads, bead, moved({at.x, 0, at.y}) * turned(0.013 * k));
      }
    };
    row({-half.x, -half.y}, {half.x, -half.y});
    row({half.x, -half.y}, {half.x, half.y});
    row({half.x, half.y}, {-half.x, half.y});
    row({-half.x, half.y}, {-half.x, -half.y});
    scene_.place(scene_.add(beads, oak_, kCrease60), board());
  }

  void addRelief() {
    Solid flowers = rosette(0.062, 0.011, 8, 9);
    append(flowers, rosette(0.04, 0.0085, 8, 9), moved({0, 0.0075, 0}) * turned(0.0625));
    append(flowers, lathe(std::array{glm::dvec2(0.013, 0), glm::dvec2(0.0125, 0.013),
                                     glm::dvec2(0.009, 0.017), glm::dvec2(0.003, 0.0185)},
                          24));
    for (int k = 0; k < 14; ++k) {
      append(flowers, ball(0.0021, 8, 6), turned(k / 14.0) * moved({0.0138, 0.0128, 0}));
    }
    const Solid small = rosette(0.021, 0.0065, 6, 9);
    for (const double x : {-1.0, 1.0}) {
      append(flowers, small, moved({x * 0.128, 0, 0}) * turned(0.04));
      append(flowers, ball(0.0048, 14, 9), moved({x * 0.128, 0.0035, 0}));
    }
    scene_.place(scene_.add(flowers, oak_, kCrease60), board());
    Solid scrolls;
    const Solid curl = scroll(0.036);
    // Four scrolls round the flower: a turn about z by half mirrors nothing, so pairs face away.
    for (const double x : {0.0, 0.5}) {
      append(scrolls, curl, turned(x) * moved({0.062, 0.0015, -0.012}) * turned(0.04));
      append(scrolls, curl, turned(x) * moved({0.15, 0.0015, 0.022}) * turned(0.5 + 0.06));
    }
    scene_.place(scene_.add(scrolls, oak_, kCrease75), board());
    // Reeds along the upper and lower edge of the panel.
    Solid reeds;
    for (const double side : {-1.0, 1.0}) {
      for (int k = 0; k < 15; ++k) {
        const double x = -0.049 + 0.007 * k;
        const double from = 0.068 + 0.006 * std::abs(k - 7) / 7.0, to = 0.092;
        const Path path{{x, 0.0002, side * from},
                        {x, 0.0008, side * (from + 0.002)},
                        {x, 0.001, side * (to - 0.002)},
                        {x, 0.0002, side * to}};
        append(reeds, tube(path, std::array{0.001, 0.0026, 0.0026, 0.001}, 9));
      }
    }
    scene_.place(scene_.add(reeds, oak_, kCrease75), board());
  }

  void addChessmen() {
    const auto stand = [&](uint32_t piece, double x, double z, double turn = 0) {
      scene_.place(piece, moved({x, -0.0004, z}) * turned(turn));
    };
    const uint32_t white = scene_.add(pawn(), ivory_, kCrease60),
                   black = scene_.add(pawn(), ebony_, kCrease60);
    stand(white, -0.012, 0.058);
    stand(white, 0.052, 0.014);
    stand(white, -0.115, 0.02);
    stand(black, -0.062, 0.082);
    stand(black, 0.005, -0.022);
    stand(scene_.add(king(), ivory_, kCrease60), -0.06, 0.022);
    stand(scene_.add(queen(), ebony_, kCrease60), -0.022, 0.005, 0.1);
    stand(scene_.add(rook(), ebony_, kCrease60), -0.14, -0.03, 0.05);
    stand(scene_.add(bishop(), ivory_, kCrease60), -0.095, -0.018);
    stand(scene_.add(knight(), ivory_, kCrease60), 0.026, 0.048, 0.06);
    // A pawn that fell over rests on its foot and its head.
    scene_.place(black, moved({-0.106, 0.0068, 0.075}) * turned(0.14) * turnedZ(-0.222));
  }

  void addThings() {
    const std::array line{glm::dvec3(-0.2, 0.0031, 0.07),    glm::dvec3(-0.165, 0.0031, 0.055),
                          glm::dvec3(-0.145, 0.0031, 0.085), glm::dvec3(-0.1, 0.0031, 0.118),
                          glm::dvec3(-0.045, 0.0031, 0.112), glm::dvec3(0.0, 0.0031, 0.1),
                          glm::dvec3(0.03, 0.0031, 0.124),   glm::dvec3(0.068, 0.0031, 0.118)};
    scene_.put(chain(curve(line, 24), 0.0013), gold_, kCrease75);
    const uint32_t band = scene_.add(fingerRing(0.0092), gold_, kCrease60);
    const uint32_t jewel = scene_.add(jewelRing(0.0088), gold_, kCrease35);
    scene_.place(band, moved({0.036, -0.0003, 0.088}));
    scene_.place(jewel, moved({0.012, 0.0006, 0.079}) * turned(0.31) * turnedZ(0.015));
    scene_.place(band, moved({0.0275, 0.0103, 0.104}) * turned(0.07) * turnedX(0.21));
    const uint32_t piece = scene_.add(coin(0.0118, 0.0021), gold_, kCrease35);
    for (uint32_t k = 0; k < 4; ++k) {
      scene_.place(piece, moved({0.086 + hashBetween(k, -0.002, 0.002), -0.0002 + 0.00213 * k,
                                 0.07 + hashBetween(k + 9, -0.0015, 0.002)}) *
                              turned(hashUnit(k + 20)));
    }
    scene_.place(piece, moved({0.108, 0.0048, 0.0855}) * turned(0.6) * turnedX(0.085));
    // A comb that leans on the pile of coins.
    const glm::dmat4 place =
        moved({0.075, 0.0113, 0.034}) * turned(0.04) * turnedX(0.29) * turnedZ(0.003);
    scene_.place(scene_.add(comb(0.086, 0.026, 34), horn_), place);
    const Die made = die(0.0135);
    const uint32_t body = scene_.add(made.body, ivory_),
                   pips = scene_.add(made.pips, ebony_, kCrease60);
    for (const glm::dmat4& at : {moved({0.135, -0.0002, 0.03}) * turned(0.06),
                                 moved({0.116, -0.0002, 0.052}) * turned(0.33)}) {
      scene_.place(body, at);
      scene_.place(pips, at);
    }
  }

  void addSewing() {
    const glm::dmat4 place = moved({0.128, -0.0003, -0.02});
    scene_.place(scene_.add(spool(0.0125, 0.03), oak_, kCrease60), place);
    scene_.place(scene_.add(thread(0.0085, 0.0062, 0.0238, 0.0011), red_, kCrease75), place);
    Solid needle = tube({{0, 0, 0}, {0.012, 0, 0}, {0.036, 0, 0}, {0.042, 0, 0}},
                        std::array{0.00015, 0.00055, 0.0007, 0.0007}, 8);
    Path eye;
    for (int k = 0; k < 14; ++k)
      eye.emplace_back(0.0445 + 0.003 * cosTurns(k / 14.0), 0, 0.00095 * sinTurns(k / 14.0));
    append(needle, hoop(eye, 0.0004, 6));
    scene_.place(scene_.add(needle, gold_, kCrease60), moved({0.12, 0.0006, 0.075}) * turned(0.12));
  }

  Assembly scene_{"carving"};
  uint32_t walnut_ = scene_.plain("walnut", {0.27f, 0.17f, 0.1f});
  uint32_t oak_ = scene_.plain("oak", {0.54f, 0.38f, 0.22f});
  uint32_t ivory_ = scene_.plain("ivory", {0.76f, 0.7f, 0.58f});
  uint32_t ebony_ = scene_.plain("ebony", {0.09f, 0.075f, 0.065f});
  uint32_t gold_ = scene_.plain("gold", {0.65f, 0.48f, 0.18f});
  uint32_t horn_ = scene_.plain("horn", {0.5f, 0.3f, 0.14f});
  uint32_t red_ = scene_.plain("red thread", {0.5f, 0.06f, 0.07f});
};

}  // namespace

Scene makeCarving() {
  return Carving().build();
}

}  // namespace grisaille::scene
