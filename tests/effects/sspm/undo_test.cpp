// SPDX-License-Identifier: MIT
// Undo of the newest shots restores the picture before them, bit for bit.
#include <gtest/gtest.h>

#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

class UndoTest : public BackendTest {
 protected:
  using Pictures = std::vector<std::vector<float>>;
  static constexpr size_t kUndone = 100;

  Pictures picture(PaintFrame& frame, std::span<const lab::Shot> shots) {
    const std::vector<std::string> outputs = {"paint", "paint_coverage", "paint_owner"};
    frame.render(kCrease, kWidth, kHeight, shots, outputs);
    EXPECT_EQ(frame.waiting(), 0u);
    Pictures pictures;
    for (const std::string& output : outputs) pictures.push_back(frame.read(output).pixels);
    return pictures;
  }

  // The last hundred shots come in steps of up to 20, and leave one by one, as undo removes them.
  void expectExact(PaintFrame& frame, std::span<const lab::Shot> shots) {
    const size_t base = shots.size() - kUndone;
    const Pictures before = picture(frame, shots.first(base));
    for (const size_t more : {1, 2, 10, 30, 50, 70, 85, 100})
      picture(frame, shots.first(base + more));
    EXPECT_NE(picture(frame, shots), before) << "the shots must show";
    for (size_t left = kUndone - 1; left > 0; --left) {
      frame.render(kCrease, 16, 16, shots.first(base + left), {"paint"});
    }
    EXPECT_EQ(picture(frame, shots.first(base)), before);
  }

  static std::vector<lab::Shot> crowd(size_t count, double spread, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<lab::Shot> shots;
    while (shots.size() < count) {
      if (shots.size() % 7 == 6) {  // a twin of an older shot
        shots.push_back(shots[random() % shots.size()]);
        continue;
      }
      const glm::dvec3 origin(2 * unit(random) - 1, 0.4 + unit(random), 0.4 + unit(random));
      const double along = spread * unit(random);
      const bool floor = random() % 2 == 0;
      const glm::dvec3 target(spread * (unit(random) - 0.5), floor ? 0 : along, floor ? along : 0);
      shots.push_back(shotAt(origin, target, randomColor(random)));
    }
    return shots;
  }
};
GRISAILLE_ON_EVERY_DEVICE(UndoTest);

// New shots hide old ones, which leave the lists and come back.
TEST_P(UndoTest, AHundredShotsThatHideOthers) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  for (const char* fade : {"0", "0.5"}) {
    frame.set({{"edge_fade", fade}});
    expectExact(frame, crowd(300, 0.8, 5));
  }
}

}  // namespace
}  // namespace grisaille::tests
