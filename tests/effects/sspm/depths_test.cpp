// SPDX-License-Identifier: MIT
// Hosts that draw depth pictures of muzzles, and have them some frames later.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

constexpr size_t kPicturesAShot = 5;

// Draws the pictures of a muzzle so many frames after the frame in which they are first asked for.
class LateDepths : public TracedDepths {
 public:
  LateDepths(const trace::RayTracer& tracer, int late) : TracedDepths(tracer), late_(late) {}
  void draw(const grisaille_depth_view& view, std::span<float> depth) override {
    const int asked = asked_.try_emplace(view.origin[0], frame_).first->second;
    if (isHidden(view) || frame_ - asked < late_) {
      ++unknown_;
      std::ranges::fill(depth, kUnknown);
    } else {
      TracedDepths::draw(view, depth);
    }
    if (halfKnown_) std::ranges::fill(depth.first(depth.size() / 2), kUnknown);
  }
  // Number of pictures that could not be drawn in the last frame.
  size_t next() {
    ++frame_;
    return std::exchange(unknown_, 0);
  }
  // Muzzles at smaller x are never drawn.
  void hideBelow(double x) { hidden_ = x; }
  // Only the lower half of each picture is known.
  void halve(bool halve) { halfKnown_ = halve; }

 private:
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  bool isHidden(const grisaille_depth_view& view) const { return view.origin[0] < hidden_; }

  int late_, frame_ = 0;
  size_t unknown_ = 0;
  double hidden_ = -std::numeric_limits<double>::infinity();
  bool halfKnown_ = false;
  std::map<double, int> asked_;  // frame by the muzzle's x
};

class DepthsTest : public BackendTest {
 protected:
  static std::vector<lab::Shot> shots() {
    std::mt19937 random(4);
    std::vector<lab::Shot> all;
    for (int i = 0; i < 12; ++i) {
      const double x = 0.1 * i - 0.6;
      all.push_back(shotAt({x, 0.7, 1.2}, {-x, 0.4, 0}, randomColor(random)));
    }
    return all;
  }
  static void render(PaintFrame& frame) { frame.render(kCrease, kWidth, kHeight, shots()); }
};
GRISAILLE_ON_EVERY_DEVICE(DepthsTest);

// A frame asks for the pictures of one shot that the host does not have, whatever its patience, and
// for no further one. In the end all shots are placed.
TEST_P(DepthsTest, AFrameAsksForOneShotThatTheHostDoesNotHave) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  TracedDepths prompt(rays.tracer());
  PaintFrame expected(device(), scene);
  expected.setDepths(&prompt);
  render(expected);
  EXPECT_EQ(expected.waiting(), 0u);
  for (const int late : {1, 3, 6}) {
    LateDepths depths(rays.tracer(), late);
    PaintFrame frame(device(), scene);
    frame.setDepths(&depths);
    for (int i = 0; i < 200; ++i) {
      render(frame);
      EXPECT_LE(depths.next(), kPicturesAShot) << late << ", frame " << i;
      if (frame.waiting() == 0) break;
      EXPECT_GT(frame.waiting(), 0u);
    }
    EXPECT_EQ(frame.waiting(), 0u) << late;
    EXPECT_EQ(frame.read("paint").pixels, expected.read("paint").pixels) << late;
  }
}

// Shots whose pictures never come do not hold the others up.
TEST_P(DepthsTest, ShotsThatAreNeverDrawnHoldNoOthersUp) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  const std::vector<lab::Shot> all = shots();
  for (const bool newest : {false, true}) {
    std::vector<lab::Shot> list = all;
    if (newest) std::ranges::reverse(list);
    LateDepths depths(rays.tracer(), 0);
    depths.hideBelow(0);
    PaintFrame frame(device(), scene);
    frame.setDepths(&depths);
    for (int i = 0; i < 100; ++i) {
      frame.render(kCrease, kWidth, kHeight, list);
      EXPECT_LE(depths.next(), kPicturesAShot);
    }
    const auto hidden =
        std::ranges::count_if(all, [](const lab::Shot& shot) { return shot.origin[0] < 0; });
    EXPECT_EQ(frame.waiting(), static_cast<uint64_t>(hidden)) << newest;
  }
}

// A host that knew half of a shot's pictures may know nothing of them later.
TEST_P(DepthsTest, PicturesMayGoAgain) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  LateDepths depths(rays.tracer(), 0);
  depths.halve(true);
  PaintFrame frame(device(), scene);
  frame.setDepths(&depths);
  render(frame);
  const std::vector<float> half = frame.read("paint").pixels;
  const uint64_t waiting = frame.waiting();
  EXPECT_GT(waiting, 0u);
  depths.hideBelow(std::numeric_limits<double>::infinity());
  depths.next();
  render(frame);
  EXPECT_EQ(frame.waiting(), waiting);
  EXPECT_EQ(frame.read("paint").pixels, half);
  EXPECT_LE(depths.next(), 2 * kPicturesAShot);
  depths.halve(false);
  depths.hideBelow(-std::numeric_limits<double>::infinity());
  for (int i = 0; i < 100 && frame.waiting() > 0; ++i) render(frame);
  EXPECT_EQ(frame.waiting(), 0u);
  EXPECT_NE(frame.read("paint").pixels, half);
}

}  // namespace
}  // namespace grisaille::tests
