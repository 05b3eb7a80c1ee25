// SPDX-License-Identifier: MIT
// The oracles alone, on scenes with known results, without shaders.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "lab/oracle/occlusion.h"
#include "lab/oracle/paint.h"
#include "lab/stability/comparison.h"

namespace grisaille::tests {
namespace {

using namespace lab::oracle;
using lab::Shot;
using lab::stability::cornerVisibility;
using lab::stability::pixelsToCompare;

constexpr glm::uvec2 kSize(48, 32);

// A floor y = 0, with or without a wall at z = 0, seen by exact rays.
View viewOf(const scene::Camera& camera, bool wall) {
  image::Image depth{.width = kSize.x, .height = kSize.y, .channels = 1, .pixels = {}};
  image::Image normal{.width = kSize.x, .height = kSize.y, .channels = 3, .pixels = {}};
  for (uint32_t y = 0; y < kSize.y; ++y) {
    for (uint32_t x = 0; x < kSize.x; ++x) {
      const glm::dvec3 ray =
          scene::rayAt(scene::viewOf(camera, kSize), glm::dvec2(x + 0.5, y + 0.5)).direction;
      const double floor = ray.y < 0 ? -camera.eye.y / ray.y : 0;
      const double ahead = wall && ray.z < 0 ? -camera.eye.z / ray.z : 0;
      const bool onWall = ahead > 0 && (floor == 0 || ahead < floor);
      depth.pixels.push_back(static_cast<float>(onWall ? ahead : floor));
      const glm::vec3 n = onWall ? glm::vec3(0, 0, 1) : glm::vec3(0, floor > 0 ? 1 : 0, 0);
      normal.pixels.insert(normal.pixels.end(), {n.x, n.y, n.z});
    }
  }
  return {
      camera,
      kSize,
      0,
      {.depth = depth, .normal = normal, .back = {}, .next = {}, .thickness = {}, .colour = {}}};
}

const scene::Camera kCamera = {.eye = glm::dvec3(0.3, 1.2, 2), .target = glm::dvec3(0, 0.1, 0)};

TEST(Oracle, AViewPutsPixelsBackWhereTheyWere) {
  const View view = viewOf(kCamera, false);
  for (const glm::ivec2 pixel : {glm::ivec2(0, 31), glm::ivec2(24, 20), glm::ivec2(47, 28)}) {
    const glm::dvec3 place = kCamera.eye + scene::worldFromView(kCamera) * view.position(pixel);
    EXPECT_NEAR(place.y, 0, 1e-6);
    EXPECT_EQ(view.depth(pixel - glm::ivec2(100, 0)), view.depth({0, pixel.y}));
  }
  EXPECT_TRUE(view.holds({47, 31}));
  EXPECT_FALSE(view.holds({48, 0}));
  EXPECT_FALSE(view.holds({0, -1}));
}

TEST(Oracle, APlaneIsOpen) {
  const View view = viewOf(kCamera, false);
  for (const bool classic : {false, true}) {
    for (const int scale : {1, 2, 4}) {
      const auto oracle = makeOcclusion(view, {.classic = classic, .slices = 4, .scale = scale});
      for (const glm::ivec2& pixel : pixelsToCompare(view.size())) {
        ASSERT_NEAR(oracle->visibility(pixel), 1, 1e-9) << pixel.x << ", " << pixel.y;
      }
    }
  }
}

// The share of cosine-weighted rays that hit the wall within the radius, estimated with random
// rays.
TEST(Oracle, ACornersVisibilityIsThatOfRays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double away : {0.0, 0.1, 0.5, 0.9}) {
    int open = 0;
    constexpr int kRays = 200000;
    for (int i = 0; i < kRays; ++i) {
      const double r = std::sqrt(unit(random)), angle = 2 * M_PI * unit(random);
      open += r * std::cos(angle) > away ? 0 : 1;  // the wall is farther away than the radius
    }
    EXPECT_NEAR(cornerVisibility(away), double{1} * open / kRays, 0.005) << away;
  }
  EXPECT_EQ(cornerVisibility(1), 1);
  EXPECT_EQ(cornerVisibility(7), 1);
}

TEST(Oracle, SlicesFindACorner) {
  const View view = viewOf(kCamera, true);
  const OcclusionSettings settings{
      .kernelSize = 8192, .blurSize = 0, .slices = 64, .thickness = 10, .scale = 1};
  const auto oracle = makeOcclusion(view, settings);
  const glm::dmat3 axes = scene::worldFromView(kCamera);
  double sum = 0, count = 0;
  for (int y = 8; y < 24; ++y) {
    for (int x = 12; x < 36; ++x) {
      const glm::dvec3 place = kCamera.eye + axes * view.position({x, y});
      const double error =
          oracle->visibility({x, y}) - cornerVisibility(std::max(place.y, place.z) / 0.5);
      sum += error * error;
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 0.03);
}

TEST(Oracle, OpenDirectionsOfAPlaneAreItsNormal) {
  const View view = viewOf(kCamera, false);
  const auto oracle =
      makeOcclusion(view, {.kernelSize = 192, .blurSize = 5, .slices = 16, .scale = 1});
  for (const glm::ivec2& pixel : pixelsToCompare(view.size())) {
    if (view.depth(pixel) == 0) continue;
    EXPECT_GT(oracle->bentNormal(pixel).y, 0.999) << pixel.x << ", " << pixel.y;
  }
}

TEST(Oracle, AHistoryAveragesNoiseAndForgetsWhatIsOld) {
  const View view = viewOf(kCamera, true);
  const OcclusionSettings settings{.blurSize = 0, .history = 16, .scale = 1};
  const OcclusionSettings still{.kernelSize = 768, .blurSize = 0, .slices = 64, .scale = 1};
  const auto exact = makeOcclusion(view, still);
  std::shared_ptr<const Past> past;
  std::vector<double> errors;
  for (int frame = 0; frame < 8; ++frame) {
    const auto oracle = makeOcclusion(view, settings, past);
    double sum = 0;
    for (const glm::ivec2& pixel : pixelsToCompare(view.size())) {
      const double error = oracle->visibility(pixel) - exact->visibility(pixel);
      sum += error * error;
    }
    errors.push_back(std::sqrt(sum));
    past = oracle->past();
  }
  EXPECT_LT(errors[1], errors[0]);
  EXPECT_LT(errors[7], 0.5 * errors[0]);
  // Surfaces that earlier frames did not show have no history.
  scene::Camera away = kCamera;
  away.target = kCamera.eye + (kCamera.eye - kCamera.target) + glm::dvec3(0, -3, 0);
  const View other = viewOf(away, false);
  const auto after = makeOcclusion(other, settings, past);
  const auto first = makeOcclusion(other, {.blurSize = 0, .history = 1, .scale = 1});
  EXPECT_NEAR(after->visibility({24, 28}), first->visibility({24, 28}), 1e-12);
}

TEST(Oracle, MatterEndsAtItsBack) {
  const View plain = viewOf(kCamera, true);
  image::Image depth{.width = kSize.x, .height = kSize.y, .channels = 1, .pixels = {}};
  image::Image normal{.width = kSize.x, .height = kSize.y, .channels = 3, .pixels = {}};
  image::Image back = depth;
  for (int y = 0; y < plain.size().y; ++y) {
    for (int x = 0; x < plain.size().x; ++x) {
      depth.pixels.push_back(static_cast<float>(plain.depth({x, y})));
      back.pixels.push_back(static_cast<float>(plain.depth({x, y})) * 1.0001f);
      const glm::vec3 n(plain.worldNormal({x, y}));
      normal.pixels.insert(normal.pixels.end(), {n.x, n.y, n.z});
    }
  }
  const View thin(
      kCamera, kSize, 0,
      {.depth = depth, .normal = normal, .back = back, .next = {}, .thickness = {}, .colour = {}});
  const auto sum = [](const View& view, bool drawn) {
    const auto oracle = makeOcclusion(view, {.kernelSize = 96,
                                             .blurSize = 0,
                                             .slices = 8,
                                             .thickness = 0.7,
                                             .backs = drawn ? OcclusionSettings::Backs::kDrawn
                                                            : OcclusionSettings::Backs::kAssumed,
                                             .scale = 1});
    double all = 0;
    for (const glm::ivec2& pixel : pixelsToCompare(view.size())) all += oracle->visibility(pixel);
    return all;
  };
  EXPECT_GT(sum(thin, true), sum(plain, false) + 1);
  EXPECT_EQ(sum(thin, false), sum(plain, false));
}

TEST(Oracle, TheClassicFindsACorner) {
  const View view = viewOf(kCamera, true);
  const auto oracle =
      makeOcclusion(view, {.classic = true, .kernelSize = 256, .blurSize = 4, .intensity = 2});
  double least = 1, most = 0;
  for (const glm::ivec2& pixel : pixelsToCompare(view.size())) {
    least = std::min(least, oracle->visibility(pixel));
    most = std::max(most, oracle->visibility(pixel));
  }
  EXPECT_NEAR(least, 0.5, 0.15);
  EXPECT_EQ(most, 1);
}

TEST(Oracle, WhatTheLastPassDoes) {
  EXPECT_NEAR(finished(0.5, {.intensity = 1, .power = 2}), 0.25, 1e-12);
  EXPECT_EQ(finished(0.5, {.intensity = 10}), 0);
  EXPECT_EQ(finished(0.2, {.intensity = 0}), 1);
  EXPECT_GT(finished(0.5, {.albedo = 0.8}), 0.5);
}

// One shot at a wall, with a pixel on its ray, beside it, out of range, and behind the muzzle.
TEST(Oracle, PaintIsItsDefinition) {
  const Shot shot{.origin = {0, 0, 1}, .direction = {0, 0, -1}, .color = {1, 0.5f, 0}, .range = 0};
  const PaintSettings settings{.full = 0.05, .edgeFade = 0, .splatSharpness = 1};
  const auto at = [&](const glm::dvec3& place) {
    return paintOf(place, 3, 1e-3, layersOf({&shot, 1}, settings, true), settings);
  };
  EXPECT_EQ(at({0, 0, 0}).coverage, 1);
  EXPECT_EQ(at({0, 0, 0}).paint, glm::dvec4(1, 0.5, 0, 1));
  EXPECT_NEAR(at({0.1, 0, 0}).coverage, 0.5, 1e-12);
  EXPECT_EQ(at({0.26, 0, 0}).coverage, 0);
  EXPECT_EQ(at({0, 0, 2}).coverage, 0);
  // In `surface` mode, facets that face away or that the muzzle does not see get no paint.
  const auto seen = [&](const glm::dvec3& facet, bool sees) {
    const Sight sight{.facet = facet, .sees = [&](const auto&) { return sees; }};
    return paintOf({0, 0, 0}, 3, 1e-3, layersOf({&shot, 1}, settings, false), settings, sight)
        .coverage;
  };
  EXPECT_EQ(seen({0, 0, 1}, true), 1);
  EXPECT_EQ(seen({0, 0, -1}, true), 0);
  EXPECT_EQ(seen({0, 0, 0}, true), 0);
  EXPECT_EQ(seen({0, 0, 1}, false), 0);
}

}  // namespace
}  // namespace grisaille::tests
