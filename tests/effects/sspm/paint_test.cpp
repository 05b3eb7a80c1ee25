// SPDX-License-Identifier: MIT
// Behaviour that users of paint rely on, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

// The corner, moved to another place in the world.
scene::Scene cornerAt(const glm::dvec3& place) {
  scene::Scene scene = cornerScene();
  for (scene::Instance& instance : scene.instances) {
    instance.worldFromObject[3] += glm::dvec4(place, 0);
  }
  computeBounds(scene);
  return scene;
}

std::vector<lab::Shot> someShots(uint32_t count, uint32_t seed, const glm::dvec3& place = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<lab::Shot> shots;
  for (uint32_t i = 0; i < count; ++i) {
    const glm::dvec3 origin(3 * unit(random) - 1.5, 0.2 + 2 * unit(random), 0.3 + 2 * unit(random));
    const glm::dvec3 target(3 * unit(random) - 1.5, 1.5 * unit(random), 0);
    shots.push_back(shotAt(place + origin, place + target, randomColor(random)));
  }
  return shots;
}

class PaintTest : public BackendTest {
 protected:
  void look(PaintFrame& frame, std::span<const lab::Shot> shots) {
    frame.render(kCrease, kWidth, kHeight, shots,
                 {"paint", "paint_coverage", "paint_owner", "depth"});
  }
};
GRISAILLE_ON_EVERY_DEVICE(PaintTest);

TEST_P(PaintTest, TheNewestWins) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  for (const char* mode : {"surface", "per_shot"}) {
    PaintFrame frame(device(), scene);
    frame.setRays(&rays);
    frame.set({{"mode", mode}, {"shot_limit", "1000"}});
    std::vector<lab::Shot> shots = someShots(150, 3);
    for (const glm::vec3 color : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
      shots.push_back(shotAt(kCrease.eye, kCrease.target, color));
      look(frame, shots);
      const image::Image paint = frame.read("paint");
      for (uint32_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(paint.at(kWidth / 2, kHeight / 2, c), color[static_cast<int>(c)], 0.01) << mode;
      }
      EXPECT_EQ(paint.at(kWidth / 2, kHeight / 2, 3), 1.0f) << mode;
      EXPECT_EQ(frame.read("paint_owner").at(kWidth / 2, kHeight / 2),
                static_cast<float>(shots.size()))
          << mode;
    }
  }
}

// The picture depends only on the list, not on the steps that led to it.
TEST_P(PaintTest, ThePictureIsTheListsAlone) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  const std::vector<lab::Shot> shots = someShots(240, 5);
  const Settings rules = {{"edge_fade", "0.1"}, {"paint_range", "0.3"}};
  const auto fresh = [&](size_t count) {
    PaintFrame frame(device(), scene);
    frame.setRays(&rays);
    frame.set(rules);
    look(frame, std::span(shots).first(count));
    return frame.read("paint").pixels;
  };
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  frame.set(rules);
  // Fired in bursts, undone, fired again, cleared.
  for (const size_t count : {1u, 40u, 41u, 200u, 150u, 240u, 30u, 0u, 120u}) {
    look(frame, std::span(shots).first(count));
    EXPECT_EQ(frame.waiting(), 0u);
    EXPECT_EQ(frame.read("paint").pixels, fresh(count)) << count;
  }
}

TEST_P(PaintTest, FarFromTheWorldsOriginPaintIsTheSame) {
  const glm::dvec3 place(1048576, 0, -2097152);
  const scene::Scene near = cornerScene(), far = cornerAt(place);
  TracedRays nearRays(near), farRays(far);
  scene::Camera camera = kCrease;
  camera.eye += place;
  camera.target += place;
  PaintFrame a(device(), near), b(device(), far);
  a.setRays(&nearRays);
  b.setRays(&farRays);
  const std::vector<lab::Shot> here = someShots(60, 9), there = someShots(60, 9, place);
  a.render(kCrease, kWidth, kHeight, here, {"paint", "paint_coverage"});
  b.render(camera, kWidth, kHeight, there, {"paint", "paint_coverage"});
  for (const char* output : {"paint", "paint_coverage"}) {
    const image::Image first = a.read(output), second = b.read(output);
    size_t different = 0;
    for (size_t i = 0; i < first.pixels.size(); ++i) {
      different += std::abs(first.pixels[i] - second.pixels[i]) > 2.0f / 255 ? 1 : 0;
    }
    EXPECT_LE(different, first.pixels.size() / 1000) << output;
  }
}

TEST_P(PaintTest, WithoutRaysShotsWait) {
  const scene::Scene scene = cornerScene();
  PaintFrame frame(device(), scene);
  const std::vector<lab::Shot> shots = someShots(5, 1);
  look(frame, shots);
  EXPECT_EQ(frame.waiting(), 5u);
  for (const float value : frame.read("paint").pixels) ASSERT_EQ(value, 0.0f);
  TracedRays rays(scene);
  frame.setRays(&rays);
  look(frame, shots);
  EXPECT_EQ(frame.waiting(), 0u);
  const image::Image coverage = frame.read("paint_coverage");
  EXPECT_GT(*std::max_element(coverage.pixels.begin(), coverage.pixels.end()), 0.5f);
}

// A free-standing pole, narrower than the squares of the coarse picture.
TEST_P(PaintTest, ThinThingsThatStandFreeArePainted) {
  scene::Scene scene;
  scene.materials.emplace_back();
  const float half = 0.02f;
  addQuad(scene,
          {glm::vec3(-half, 0, 0), glm::vec3(half, 0, 0), glm::vec3(half, 2, 0),
           glm::vec3(-half, 2, 0)},
          glm::vec3(0, 0, 1));
  TracedRays rays(scene);
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  const std::vector<lab::Shot> shots = {
      shotAt(glm::dvec3(0, 1, 2), glm::dvec3(0, 1, 0), glm::vec3(1, 0, 0))};
  frame.render({.eye = glm::dvec3(0, 1, 1), .target = glm::dvec3(0, 1, 0)}, kWidth, kHeight, shots);
  EXPECT_EQ(frame.read("paint_coverage").at(kWidth / 2, kHeight / 2), 1.0f);
}

// A wall in between: no paint behind it or on its far side.
TEST_P(PaintTest, PaintStopsAtTheFirstSurface) {
  scene::Scene scene = cornerScene();
  scene.materials[0].doubleSided = true;
  addQuad(scene, {glm::vec3(-1, 0, 1), glm::vec3(1, 0, 1), glm::vec3(1, 2, 1), glm::vec3(-1, 2, 1)},
          glm::vec3(0, 0, 1));
  computeBounds(scene);
  TracedRays rays(scene);
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  const std::vector<lab::Shot> shots = {
      shotAt(glm::dvec3(0, 1, 3), glm::dvec3(0, 1, 0), glm::vec3(1, 0, 0))};
  const auto painted = [&](const scene::Camera& camera) {
    frame.render(camera, kWidth, kHeight, shots, {"paint_coverage"});
    const image::Image coverage = frame.read("paint_coverage");
    return std::any_of(coverage.pixels.begin(), coverage.pixels.end(),
                       [](float a) { return a > 0; });
  };
  EXPECT_TRUE(painted({.eye = glm::dvec3(0, 1, 3), .target = glm::dvec3(0, 1, 1)}));
  // Between the wall and the surface behind it, looking in both directions.
  EXPECT_FALSE(painted({.eye = glm::dvec3(0, 1, 0.5), .target = glm::dvec3(0, 1, 0)}));
  EXPECT_FALSE(painted({.eye = glm::dvec3(0, 1, 0.5), .target = glm::dvec3(0, 1, 1)}));
}

}  // namespace
}  // namespace grisaille::tests
