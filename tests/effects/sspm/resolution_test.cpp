// SPDX-License-Identifier: MIT
// Paint in `surface` mode below full resolution, compared with full resolution, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kWidth = 160;
constexpr uint32_t kHeight = 120;
constexpr float kSame = 2.0f / 255;

const scene::Camera kCrease = {.eye = glm::dvec3(0.3, 1.5, 2.5), .target = glm::dvec3(0, 0.5, 0)};

std::vector<lab::Shot> someShots(uint32_t count) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<lab::Shot> shots;
  for (uint32_t i = 0; i < count; ++i) {
    const glm::dvec3 origin(3 * unit(random) - 1.5, 0.2 + 2 * unit(random), 0.3 + 2 * unit(random));
    const glm::dvec3 target(3 * unit(random) - 1.5, 1.5 * unit(random), 0);
    shots.push_back(shotAt(origin, target, randomColor(random), 0.4f));
  }
  return shots;
}

struct Shown {
  image::Image paint, coverage, owner, facets;
};

class ResolutionTest : public BackendTest {
 protected:
  // Renders in a fresh instance; rays are traced in `scene` as well.
  Shown look(const scene::Scene& scene, const scene::Camera& camera, const Settings& settings,
             std::span<const lab::Shot> shots, uint32_t width = kWidth, uint32_t height = kHeight) {
    TracedRays rays(scene);
    PaintFrame frame(device(), scene);
    frame.setRays(&rays);
    frame.set(settings);
    frame.render(camera, width, height, shots,
                 {"paint", "paint_coverage", "paint_owner", "facet_normal"});
    return {frame.read("paint"), frame.read("paint_coverage"), frame.read("paint_owner"),
            frame.read("facet_normal")};
  }
};
GRISAILLE_ON_EVERY_DEVICE(ResolutionTest);

// Whether all pixels within `reach` share one facet normal, coverage and owner.
bool isEven(const Shown& full, uint32_t x, uint32_t y, uint32_t reach) {
  const uint32_t right = std::min(x + reach, kWidth - 1), low = std::min(y + reach, kHeight - 1);
  for (uint32_t v = y - std::min(y, reach); v <= low; ++v) {
    for (uint32_t u = x - std::min(x, reach); u <= right; ++u) {
      if (std::abs(full.coverage.at(u, v) - full.coverage.at(x, y)) > kSame ||
          full.owner.at(u, v) != full.owner.at(x, y)) {
        return false;
      }
      for (uint32_t c = 0; c < 3; ++c) {
        if (std::abs(full.facets.at(u, v, c) - full.facets.at(x, y, c)) > 0.01f) return false;
      }
    }
  }
  return true;
}

// Share of pixels with different coverage.
double differing(const Shown& a, const Shown& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.coverage.pixels.size(); ++i) {
    count += std::abs(a.coverage.pixels[i] - b.coverage.pixels[i]) > kSame ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(a.coverage.pixels.size());
}

TEST_P(ResolutionTest, AwayFromEdgesAndRimsItIsFullResolution) {
  const scene::Scene scene = cornerScene();
  const std::vector<lab::Shot> shots = someShots(40);
  const Shown full = look(scene, kCrease, {{"edge_fade", "0"}}, shots);
  for (const auto& [resolution, step] : {std::pair("half", 2u), std::pair("quarter", 4u)}) {
    for (const char* refine : {"nothing", "rims"}) {
      SCOPED_TRACE(fmt::format("{} {}", resolution, refine));
      const Shown less =
          look(scene, kCrease, {{"edge_fade", "0"}, {"resolution", resolution}, {"refine", refine}},
               shots);
      size_t even = 0, wrong = 0;
      for (uint32_t y = 0; y < kHeight; ++y) {
        for (uint32_t x = 0; x < kWidth; ++x) {
          if (!isEven(full, x, y, step)) continue;
          ++even;
          bool same = std::abs(less.coverage.at(x, y) - full.coverage.at(x, y)) <= kSame &&
                      less.owner.at(x, y) == full.owner.at(x, y);
          for (uint32_t c = 0; c < 4; ++c) {
            same = same && std::abs(less.paint.at(x, y, c) - full.paint.at(x, y, c)) <= kSame;
          }
          wrong += same ? 0 : 1;
        }
      }
      EXPECT_GT(even, kWidth * kHeight / 4);
      EXPECT_EQ(wrong, 0u);
    }
  }
}

// With refinement it is closer to full resolution, and half is closer than a quarter.
TEST_P(ResolutionTest, WhatIsAskedMoreIsNearer) {
  const scene::Scene scene = cornerScene();
  const std::vector<lab::Shot> shots = someShots(40);
  const Shown full = look(scene, kCrease, {{"edge_fade", "0"}}, shots);
  double rims[2] = {};
  for (int i = 0; i < 2; ++i) {
    const char* resolution = i == 0 ? "half" : "quarter";
    const auto far = [&](const char* refine) {
      return differing(
          full, look(scene, kCrease,
                     {{"edge_fade", "0"}, {"resolution", resolution}, {"refine", refine}}, shots));
    };
    rims[i] = far("rims");
    EXPECT_LT(rims[i], far("nothing")) << resolution;
  }
  EXPECT_LT(rims[0], rims[1]);
  EXPECT_LT(rims[0], 0.01);
  EXPECT_LT(rims[1], 0.04);
}

// Splats keep their shape: only islands and holes smaller than the distance of samples are lost,
// which many drops are at a quarter.
TEST_P(ResolutionTest, SplatsOnAFlatWallStaySharp) {
  const scene::Scene scene = wallScene();
  const scene::Camera camera = {.eye = glm::dvec3(0.4, 0.2, 3), .target = glm::dvec3(0, 0, 0)};
  // Coverage falls smoothly from one side to the other, as 3 m / distance.
  const std::vector<lab::Shot> shots = {
      shotAt(glm::dvec3(-6, 0, 4), glm::dvec3(-6, 0, 0), glm::vec3(1, 0.5f, 0), 30)};
  struct Row {
    const char* resolution;
    const char* scale;    // 0.1: cells of 3.5 pixels
    double most = 0.002;  // share of pixels that are painted in one picture alone
  };
  for (const Row& row : {Row{"half", "0.1"}, Row{"half", "0.4"}, Row{"quarter", "0.1", 0.01},
                         Row{"quarter", "0.4", 0.012}, Row{"quarter", "1.6"}}) {
    SCOPED_TRACE(fmt::format("{} at {} m", row.resolution, row.scale));
    Settings settings = {{"r0", "3"}, {"splat_scale", row.scale}, {"edge_fade", "0"}};
    const Shown full = look(scene, camera, settings, shots);
    settings.emplace_back("resolution", row.resolution);
    const Shown less = look(scene, camera, settings, shots);
    EXPECT_LT(differing(full, less), 0.001);
    size_t painted = 0, other = 0;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
      const bool here = full.paint.pixels[4 * i + 3] > 0.5f;
      painted += here ? 1 : 0;
      other += here != (less.paint.pixels[4 * i + 3] > 0.5f) ? 1 : 0;
    }
    EXPECT_GT(painted, kWidth * kHeight / 8);
    EXPECT_LT(painted, kWidth * kHeight * 7 / 8);
    EXPECT_LE(static_cast<double>(other), row.most * kWidth * kHeight);
  }
}

TEST_P(ResolutionTest, AnySizeIsWholeAndFinite) {
  const scene::Scene scene = cornerScene();
  const std::vector<lab::Shot> shots = someShots(40);
  for (const glm::uvec2 size :
       {glm::uvec2(1, 1), glm::uvec2(3, 3), glm::uvec2(2, 9), glm::uvec2(257, 129)}) {
    const Shown full = look(scene, kCrease, {}, shots, size.x, size.y);
    for (const char* resolution : {"half", "quarter"}) {
      SCOPED_TRACE(fmt::format("{} at {}x{}", resolution, size.x, size.y));
      const Shown less = look(scene, kCrease, {{"resolution", resolution}}, shots, size.x, size.y);
      for (const float value : less.paint.pixels) ASSERT_TRUE(std::isfinite(value));
      for (const float value : less.coverage.pixels) {
        ASSERT_TRUE(value >= 0 && value <= 1) << value;
      }
      // The last row and column are sampled directly.
      for (const uint32_t x : {0u, size.x - 1}) {
        for (const uint32_t y : {0u, size.y - 1}) {
          EXPECT_NEAR(less.coverage.at(x, y), full.coverage.at(x, y), kSame);
          EXPECT_EQ(less.owner.at(x, y), full.owner.at(x, y));
        }
      }
      // Coverage fades at the rims, where the low resolution blends it.
      EXPECT_LT(differing(full, less), size.x > 100 ? 0.1 : 1.0);
    }
  }
}

}  // namespace
}  // namespace grisaille::tests
