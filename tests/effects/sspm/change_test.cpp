// SPDX-License-Identifier: MIT
// A change of a parameter while paint lies on the scene: the next frame shows it, before shots are
// surveyed again, and the picture is exact once they are.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

// Pixels. A driver that snaps vertices to a sixteenth of a pixel moves the floor by less than the
// bias.
constexpr uint32_t kWide = 3 * kWidth, kHigh = 3 * kHeight;

using Pictures = std::vector<std::vector<float>>;

// A corner, and a column that stands before its wall.
scene::Scene cornerWithColumn() {
  scene::Scene scene = cornerScene();
  glm::dmat4 column(0.12);
  column[1].y = 1.6;
  column[3] = glm::dvec4(0.1, 0.8, 0.5, 1);
  addBox(scene, column);
  computeBounds(scene);
  return scene;
}

std::vector<lab::Shot> splashes(size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<lab::Shot> shots;
  while (shots.size() < count) {
    const glm::dvec3 origin(2 * unit(random) - 1, 0.4 + unit(random), 0.8 + unit(random));
    const double along = unit(random);
    const bool floor = random() % 2 == 0;
    const glm::dvec3 target(1.6 * unit(random) - 0.8, floor ? 0 : along, floor ? along : 0);
    // Every ninth has a range of its own.
    const float range = shots.size() % 9 == 8 ? 0.15f : 0;
    shots.push_back(shotAt(origin, target, randomColor(random), range));
    if (shots.size() % 11 == 10) shots.push_back(shots.back());
  }
  return shots;
}

// Which share of the pixels that `before` and `after` differ in are in `now` as they are in
// `after`.
double shareRight(const Pictures& before, const Pictures& now, const Pictures& after) {
  const auto differ = [](const Pictures& a, const Pictures& b, size_t pixel) {
    for (size_t i = 4 * pixel; i < 4 * pixel + 4; ++i) {
      if (std::abs(a[0][i] - b[0][i]) > 2.0f / 255) return true;
    }
    return false;
  };
  size_t altered = 0, right = 0;
  for (size_t pixel = 0; pixel < size_t{kWide} * kHigh; ++pixel) {
    if (!differ(before, after, pixel)) continue;
    ++altered;
    right += differ(now, after, pixel) ? 0 : 1;
  }
  EXPECT_GT(altered, kWide * kHigh / 50u);
  return static_cast<double>(right) / static_cast<double>(altered);
}

class ChangeTest : public BackendTest {
 protected:
  ChangeTest() : scene_(cornerWithColumn()), rays_(scene_) {}

  // With `impatient`, a frame that places as few shots as a frame may.
  Pictures picture(PaintFrame& frame, std::span<const lab::Shot> shots, bool impatient = false) {
    const std::vector<std::string> outputs = {"paint", "paint_coverage", "paint_owner"};
    frame.setRays(&rays_);
    frame.setPatience(impatient ? 0 : std::numeric_limits<double>::infinity());
    frame.render(kCrease, kWide, kHigh, shots, outputs);
    if (!impatient) {
      EXPECT_EQ(frame.waiting(), 0u);
    }
    Pictures pictures;
    for (const std::string& output : outputs) pictures.push_back(frame.read(output).pixels);
    return pictures;
  }

  scene::Scene scene_;
  TracedRays rays_;
};
GRISAILLE_ON_EVERY_DEVICE(ChangeTest);

// Whatever changed before, and however far placing had come then.
TEST_P(ChangeTest, ThePictureIsInTheEndAsIfNothingHadChanged) {
  const std::vector<lab::Shot> shots = splashes(120, 3);
  struct Step {
    const char* range;
    const char* fade;
    size_t count;
    int impatient;  // frames before the one that places all
  };
  constexpr Step kSteps[] = {{"0.25", "0.5", 100, 0}, {"0.4", "0.5", 100, 3},
                             {"0.15", "0.5", 100, 0}, {"0.3", "0", 120, 2},
                             {"0.3", "0.4", 90, 1},   {"1.5", "0.4", 110, 4},
                             {"0.02", "0.4", 110, 1}, {"0.25", "0.5", 120, 2}};
  PaintFrame frame(device(), scene_);
  for (const Step& step : kSteps) {
    const Settings settings = {{"paint_range", step.range}, {"edge_fade", step.fade}};
    const auto list = std::span(shots).first(step.count);
    frame.set(settings);
    for (int i = 0; i < step.impatient; ++i) picture(frame, list, true);
    if (step.impatient % 2 == 1) continue;  // the next change comes before all are placed
    PaintFrame fresh(device(), scene_);
    fresh.set(settings);
    EXPECT_EQ(picture(frame, list), picture(fresh, list)) << step.range << ", " << step.fade;
  }
}

TEST_P(ChangeTest, TheNextFrameShowsAnotherRange) {
  const std::vector<lab::Shot> shots = splashes(150, 4);
  PaintFrame frame(device(), scene_);
  frame.set({{"paint_range", "0.2"}});
  const Pictures before = picture(frame, shots);
  for (const auto& [range, least] : {std::pair("0.3", 0.97), {"0.1", 0.97}, {"0.6", 0.8}}) {
    frame.set({{"paint_range", range}});
    const Pictures now = picture(frame, shots, true);
    EXPECT_GT(frame.waiting(), 0u);
    const Pictures after = picture(frame, shots);
    EXPECT_GT(shareRight(before, now, after), least) << range;
    frame.set({{"paint_range", "0.2"}});
    EXPECT_EQ(picture(frame, shots), before);
  }
}

// Shots that undone ones had hidden in part stay in sight while they are placed anew.
TEST_P(ChangeTest, TheNextFrameShowsAnUndo) {
  std::vector<lab::Shot> shots = splashes(200, 5);
  PaintFrame frame(device(), scene_);
  frame.set({{"paint_range", "0.3"}, {"edge_fade", "0"}, {"r0", "10"}});
  const auto older = std::span(shots).first(120);
  const Pictures less = picture(frame, older);
  const Pictures all = picture(frame, shots);
  const Pictures now = picture(frame, older, true);
  EXPECT_GT(frame.waiting(), 0u);
  EXPECT_GT(shareRight(all, now, less), 0.85);
  EXPECT_EQ(picture(frame, older), less);
}

}  // namespace
}  // namespace grisaille::tests
