// SPDX-License-Identifier: MIT
// Regions of a box in front of a wall, seen from the front, with known borders.
#include "lab/claims/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/trace/scene_builder.h"

namespace grisaille::lab::claims {
namespace {

constexpr uint32_t kSide = 96;

// A wall at z = 0. In front of it, at z = 1, the face of a box of 1 m, turned by `turn` about y to
// show an edge. 96 pixels span 4 m of the wall.
trace::FlickerFrame boxFrame(double turn) {
  trace::SceneBuilder builder;
  const uint32_t white = builder.material({});
  builder.place(builder.quad({glm::vec3(-9, -9, 0), {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, white));
  const glm::dmat4 turned =
      glm::rotate(glm::translate(glm::dmat4(1), {0, 0, 1}), glm::radians(turn), {0.0, 1.0, 0.0});
  const float h = 0.5f;
  const uint32_t faces[] = {
      builder.quad({glm::vec3(-h, -h, h), {h, -h, h}, {h, h, h}, {-h, h, h}}, white),
      builder.quad({glm::vec3(h, -h, h), {h, -h, -h}, {h, h, -h}, {h, h, h}}, white)};
  for (const uint32_t face : faces) builder.place(face, turned);
  scene::computeBounds(builder.scene);
  trace::FlickerFrame frame;
  frame.camera = {.eye = {0, 0, 10}, .target = {0, 0, 0}};
  frame.camera.fovyDegrees = 2 * glm::degrees(std::atan(0.2));
  frame.hits = trace::RayTracer(builder.scene, {0, 0, 0}).castPrimary(frame.camera, kSide, kSide);
  frame.truth = {.width = kSide, .height = kSide, .channels = 1, .pixels = {}};
  frame.truth.pixels.assign(kSide * kSide, 1);
  return frame;
}

// The columns of the region in the middle row: first, last and count.
struct Columns {
  uint32_t first = kSide, last = 0, count = 0;
};

Columns columnsOf(const std::string& region, const trace::FlickerFrame& frame) {
  const auto mask = regionOf(region, frame, {.radius = 0.25, .distance = 9});
  Columns columns;
  for (uint32_t x = 0; x < kSide; ++x) {
    if (mask[kSide / 2 * kSide + x] == 0) continue;
    columns.first = std::min(columns.first, x);
    columns.last = x;
    ++columns.count;
  }
  return columns;
}

// The outline of the face is at 48 +- 0.5 m * 24 px / m * 10 / 8.5.
constexpr uint32_t kOutline = 14;

TEST(Regions, EdgesAreAboutTheOutline) {
  const trace::FlickerFrame frame = boxFrame(0);
  const Columns edges = columnsOf("edges", frame);
  EXPECT_NEAR(edges.first, kSide / 2 - kOutline - 5, 1);
  EXPECT_NEAR(edges.last, kSide / 2 + kOutline + 4, 1);
  EXPECT_NEAR(edges.count, 2 * (2 + 8), 2);
  // `flat` is the remaining area, away from edges.
  const Columns flat = columnsOf("flat", frame);
  EXPECT_NEAR(flat.count, kSide - 2 * (2 + 16), 2);
  EXPECT_EQ(columnsOf("flat+edges", frame).count, 0u);
  EXPECT_EQ(columnsOf("convex", frame).count, 0u);
}

TEST(Regions, BehindIsTheOpenWallBesideTheOutline) {
  trace::FlickerFrame frame = boxFrame(0);
  const Columns behind = columnsOf("behind", frame);
  // 0.25 m span 6 pixels of the wall.
  EXPECT_NEAR(behind.first, kSide / 2 - kOutline - 7, 1);
  EXPECT_NEAR(behind.last, kSide / 2 + kOutline + 6, 1);
  EXPECT_NEAR(behind.count, 2 * 7, 2);
  EXPECT_EQ(columnsOf("behind+near", frame).count, 0u);  // the face is at 8.5 m, the wall at 10 m
  EXPECT_EQ(columnsOf("behind+far", frame).count, behind.count);
  for (float& value : frame.truth.pixels) value = 0.9f;
  EXPECT_EQ(columnsOf("behind", frame).count, 0u);
  EXPECT_EQ(columnsOf("open", frame).count, 0u);
}

TEST(Regions, ConvexIsAboutTheEdgeThatFallsAway) {
  const Columns convex = columnsOf("convex", boxFrame(-45));
  EXPECT_NEAR(convex.first, kSide / 2 - 4, 1);
  EXPECT_NEAR(convex.last, kSide / 2 + 3, 1);
  EXPECT_EQ(columnsOf("convex+flat", boxFrame(-45)).count, 0u);
}

// The wall is 1.5 m behind the face. Only within a larger radius is it beside the face.
TEST(Regions, BesideIsWhatRestsNearWhatMoves) {
  const trace::FlickerFrame frame = boxFrame(0);
  const auto count = [&](double radius, std::vector<uint8_t> moved) {
    const auto mask = regionOf("beside", frame, {.radius = radius, .moved = moved});
    EXPECT_EQ(mask[kSide / 2 * kSide + kSide / 2], 0) << "the face itself";
    return std::ranges::count(mask, 1);
  };
  EXPECT_EQ(count(2, {}), 0);
  EXPECT_EQ(count(2, {0, 0, 0}), 0);
  EXPECT_EQ(count(1.4, {0, 1, 0}), 0);
  EXPECT_GT(count(1.8, {0, 1, 0}), 100);
  EXPECT_GT(count(2.5, {0, 1, 0}), count(1.8, {0, 1, 0}));
}

TEST(Regions, TheSkyIsInNone) {
  trace::FlickerFrame frame = boxFrame(0);
  for (trace::Hit& hit : frame.hits) hit.viewDepth = 0;
  for (const RegionInfo& region : regions()) EXPECT_EQ(columnsOf(region.key, frame).count, 0u);
}

TEST(Regions, WideningTakesASquare) {
  std::vector<uint8_t> mask(7 * 5, 0);
  mask[2 * 7 + 1] = 1;
  const auto wide = widened(mask, 7, 5, 2);
  for (uint32_t i = 0; i < wide.size(); ++i) EXPECT_EQ(wide[i], i % 7 <= 3 ? 1 : 0) << i;
  EXPECT_EQ(widened(mask, 7, 5, 0), mask);
}

}  // namespace
}  // namespace grisaille::lab::claims
