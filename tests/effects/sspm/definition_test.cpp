// SPDX-License-Identifier: MIT
// Paint compared with its definition in double precision, on every backend.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/scene/view.h"
#include "lab/oracle/paint.h"
#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

using namespace lab::oracle;

constexpr uint32_t kDefinedWidth = 128;
constexpr uint32_t kDefinedHeight = 96;

std::string text(double value) {
  return fmt::format("{}", value);
}

Settings settingsOf(const PaintSettings& s, const std::string& mode) {
  return {{"mode", mode},
          {"paint_range", text(s.paintRange)},
          {"r0", text(s.full)},
          {"shot_limit", text(static_cast<double>(s.shotLimit))},
          {"edge_fade", text(s.edgeFade)},
          {"splat_scale", text(s.splatScale)},
          {"splat_sharpness", text(s.splatSharpness)},
          {"noise_seed", text(s.noiseSeed)}};
}

// Share of pixels that differ by more than 2/255 from `expected(x, y)`.
template <typename Expected>
double different(const image::Image& paint, const image::Image& coverage, Expected&& expected) {
  size_t count = 0;
  for (uint32_t y = 0; y < paint.height; ++y) {
    for (uint32_t x = 0; x < paint.width; ++x) {
      const PaintPixel pixel = expected(x, y);
      double worst = std::abs(coverage.at(x, y) - pixel.coverage);
      for (uint32_t c = 0; c < 4; ++c) {
        const double value = paint.at(x, y, c);
        worst = std::isfinite(value)
                    ? std::max(worst, std::abs(value - pixel.paint[static_cast<int>(c)]))
                    : 1;
      }
      count += worst > 2.0 / 255 ? 1 : 0;
    }
  }
  return static_cast<double>(count) / (paint.width * paint.height);
}

class DefinitionTest : public BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(DefinitionTest);

TEST_P(DefinitionTest, PerShotIsTheDefinition) {
  const scene::Scene scene = cornerScene();
  PaintFrame frame(device(), scene);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 12; ++round) {
    const PaintSettings settings = {.paintRange = std::exp2(-4 + 5 * unit(random)),
                                    .full = std::exp2(-5 + 6 * unit(random)),
                                    .shotLimit = static_cast<size_t>(1 + 40 * unit(random)),
                                    .edgeFade = round % 3 == 0 ? 0 : unit(random),
                                    .splatScale = std::exp2(-5 + 4 * unit(random)),
                                    .splatSharpness = round % 2 == 0 ? 1 : unit(random),
                                    .noiseSeed = static_cast<uint32_t>(65535 * unit(random))};
    std::vector<lab::Shot> shots;
    for (int i = 0; i < 30; ++i) {
      const glm::dvec3 origin(4 * unit(random) - 2, 3 * unit(random) - 0.5, 3 * unit(random) - 0.5);
      const glm::dvec3 target(3 * unit(random) - 1.5, 2 * unit(random) - 0.2, 2 * unit(random) - 1);
      const float range = i % 4 == 0 ? static_cast<float>(0.05 + unit(random)) : 0.0f;
      shots.push_back(shotAt(origin, target, randomColor(random), range));
    }
    frame.set(settingsOf(settings, "per_shot"));
    frame.render(kCrease, kDefinedWidth, kDefinedHeight, shots);
    const image::Image depth = frame.read("depth");
    const scene::View view = scene::viewOf(kCrease, {kDefinedWidth, kDefinedHeight});
    const std::vector<PaintLayer> layers = layersOf(shots, settings, true);
    const double wrong =
        different(frame.read("paint"), frame.read("paint_coverage"), [&](uint32_t x, uint32_t y) {
          const double d = depth.at(x, y);
          return paintOf(scene::worldPosition(view, {x + 0.5, y + 0.5}, d), d,
                         scene::pixelSize(view, d), layers, settings);
        });
    EXPECT_LT(wrong, 0.001) << "round " << round;
  }
}

// Share of pixels that differ between the modes.
double betweenModes(PaintFrame& frame, const PaintSettings& settings, const scene::Camera& camera,
                    std::span<const lab::Shot> shots) {
  frame.set(settingsOf(settings, "surface"));
  frame.render(camera, kDefinedWidth, kDefinedHeight, shots);
  EXPECT_EQ(frame.waiting(), 0u);
  const image::Image paint = frame.read("paint"), coverage = frame.read("paint_coverage");
  frame.set(settingsOf(settings, "per_shot"));
  frame.render(camera, kDefinedWidth, kDefinedHeight, shots);
  const image::Image every = frame.read("paint"), sum = frame.read("paint_coverage");
  return different(paint, coverage, [&](uint32_t x, uint32_t y) {
    return PaintPixel{
        .paint = {every.at(x, y, 0), every.at(x, y, 1), every.at(x, y, 2), every.at(x, y, 3)},
        .coverage = sum.at(x, y)};
  });
}

// A wall of upright strips, 3 cm wide, that turn by 30 degrees to either side in turn.
scene::Scene foldedWall() {
  scene::Scene scene = wallScene();
  scene.primitives.clear();
  scene.instances.clear();
  constexpr float kStrip = 0.03f;
  const glm::vec2 turned(std::cos(glm::radians(30.0f)), std::sin(glm::radians(30.0f)));
  for (int i = -60; i < 60; ++i) {
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    const float x = static_cast<float>(i) * kStrip * turned.x;
    const float from = side > 0 ? 0.0f : kStrip * turned.y, to = kStrip * turned.y - from;
    addQuad(scene,
            {glm::vec3(x, -2, from),
             {x + kStrip * turned.x, -2, to},
             {x + kStrip * turned.x, 2, to},
             {x, 2, from}},
            {-side * turned.y, 0, turned.x});
  }
  return scene;
}

// A crease hides nothing: the map needs few rays along it, and the paint has no gap there.
TEST_P(DefinitionTest, CreasesHaveNoGapsAndNeedFewRays) {
  const scene::Scene scene = foldedWall();
  const scene::Camera camera = {.eye = glm::dvec3(0.1, 0.1, 0.9), .target = glm::dvec3(0, 0, 0)};
  TracedRays rays(scene);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const PaintSettings settings = {
      .paintRange = 0.25, .full = 1, .edgeFade = 0, .splatSharpness = 1};
  std::vector<lab::Shot> shots;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 target(0.6 * unit(random) - 0.3, 0.4 * unit(random) - 0.2, 0);
    const glm::dvec3 origin = target + glm::dvec3(unit(random) - 0.5, unit(random) - 0.5, 2);
    shots.push_back(shotAt(origin, target, randomColor(random), 0));
  }
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  EXPECT_LT(betweenModes(frame, settings, camera, shots), 0.001);
  std::printf("%s: %zu rays a shot on creases\n", GetParam().label.c_str(),
              rays.count() / shots.size());
  EXPECT_LT(rays.count(), 3000 * shots.size());
}

// On a wall that every muzzle sees whole, both modes give the same paint.
TEST_P(DefinitionTest, SurfaceIsPerShotOnAnOpenWall) {
  const scene::Scene scene = wallScene();
  const scene::Camera camera = {.eye = glm::dvec3(0.4, 0.2, 3), .target = glm::dvec3(0, 0, 0)};
  TracedRays rays(scene);
  for (uint32_t seed = 0; seed < 3; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const PaintSettings settings = {.paintRange = 0.05 + 0.3 * unit(random),
                                    .full = seed == 0 ? 1 : 0.02 + 0.2 * unit(random),
                                    .shotLimit = 65536,
                                    .edgeFade = seed == 1 ? 0 : unit(random),
                                    .splatSharpness = 1,
                                    .noiseSeed = seed};
    std::vector<lab::Shot> shots;
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 target(6 * unit(random) - 3, 5 * unit(random) - 2.5, 0);
      const glm::dvec3 origin =
          target + glm::dvec3(6 * unit(random) - 3, 6 * unit(random) - 3, 0.2 + 4 * unit(random));
      const float range = i % 7 == 0 ? static_cast<float>(0.02 + unit(random)) : 0.0f;
      shots.push_back(shotAt(origin, target, randomColor(random), range));
    }
    PaintFrame frame(device(), scene);
    frame.setRays(&rays);
    EXPECT_LT(betweenModes(frame, settings, camera, shots), 0.001) << "seed " << seed;
  }
}

}  // namespace
}  // namespace grisaille::tests
