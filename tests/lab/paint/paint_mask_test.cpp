// SPDX-License-Identifier: MIT
#include "lab/paint/paint_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "tests/core/trace/scene_builder.h"

namespace grisaille::lab {
namespace {

// Shots straight down onto a floor, with a square lid of half side 0.5 m at a height of 1 m; seen
// from 40 m to the side.
class PaintMask : public ::testing::Test {
 protected:
  PaintMask() {
    const uint32_t material = builder_.material({.name = "two-sided", .doubleSided = true});
    builder_.place(builder_.floor(glm::vec3(0), 10, material));
    builder_.place(builder_.floor(glm::vec3(0, 1, 0), 0.5, material));
    tracer_.emplace(builder_.scene, glm::dvec3(0));
    scene::Camera camera = trace::cameraAt({8, 6, 0}, {0, 0, 0});
    camera.fovyDegrees = 40;
    hits_ = tracer_->castPrimary(camera, 96, 64);
  }

  static Shot down(double x, double height, double range) {
    return {.origin = {x, height, 0}, .direction = {0, -1, 0}, .color = {1, 1, 1}, .range = range};
  }

  trace::SceneBuilder builder_;
  std::optional<trace::RayTracer> tracer_;
  std::vector<trace::Hit> hits_;
};

TEST_F(PaintMask, IsTheDiscUnderTheMuzzleLessWhatTheLidHides) {
  const std::vector<Shot> shots = {down(0, 3, 0)};
  const auto mask = paintMask(*tracer_, hits_, shots, 2);
  size_t painted = 0, shadow = 0;
  for (size_t i = 0; i < hits_.size(); ++i) {
    const glm::dvec3& p = hits_[i].position;
    const bool lid = p.y > 0.5;
    // From a height of 3 m, the lid's shadow on the floor is 3 / 2 times as wide as the lid.
    const double across = std::max(std::abs(p.x), std::abs(p.z));
    const double out = glm::length(glm::dvec2(p.x, p.z));
    if (hits_[i].viewDepth == 0 || std::abs(across - 0.75) < 1e-3 || std::abs(out - 2) < 1e-3) {
      continue;
    }
    const bool expected = lid || (out < 2 && across > 0.75);
    EXPECT_EQ(mask[i] != 0, expected) << p.x << " " << p.y << " " << p.z;
    painted += expected ? 1 : 0;
    shadow += !lid && across < 0.75 ? 1 : 0;
  }
  EXPECT_GT(painted, 200u);
  EXPECT_GT(shadow, 20u);
}

TEST_F(PaintMask, IsTheUnionOfShotsEachWithItsOwnRange) {
  const std::vector<Shot> shots = {down(-3, 1, 0.5), down(2, 1, 0)};
  const auto both = paintMask(*tracer_, hits_, shots, 1);
  const auto first = paintMask(*tracer_, hits_, std::span(shots).first(1), 1);
  const auto second = paintMask(*tracer_, hits_, std::span(shots).last(1), 1);
  size_t small = 0, large = 0;
  for (size_t i = 0; i < hits_.size(); ++i) {
    EXPECT_EQ(both[i], first[i] | second[i]);
    small += first[i];
    large += second[i];
  }
  EXPECT_GT(small, 0u);
  EXPECT_GT(large, 2 * small);
}

TEST_F(PaintMask, NothingBehindTheMuzzleAndNothingTurnedAway) {
  // Upward from between floor and lid: it reaches only the lid's lower side, which no pixel sees.
  Shot up = down(0, 0.5, 5);
  up.direction[1] = 1;
  for (const uint8_t value : paintMask(*tracer_, hits_, std::span(&up, 1), 0)) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace grisaille::lab
