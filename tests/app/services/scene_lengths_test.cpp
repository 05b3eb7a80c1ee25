// SPDX-License-Identifier: MIT
#include "app/services/scene_lengths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "app/settings/settings.h"
#include "core/scene/built_in.h"
#include "core/scene/depth_sketch.h"
#include "tests/support/scenes.h"

namespace grisaille::app {
namespace {

// The scene, `scale` times as large, at another place, without a camera of its own.
scene::Scene scaled(scene::Scene scene, double scale, const glm::dvec3& at) {
  for (scene::Instance& instance : scene.instances) {
    glm::dmat4 place(scale);
    place[3] = glm::dvec4(at, 1);
    instance.worldFromObject = place * instance.worldFromObject;
  }
  computeBounds(scene);
  scene.camera.reset();
  return scene;
}

TEST(SceneLengths, TheRadiusGrowsWithTheScene) {
  scene::Scene atrium = scene::makeAtrium();
  const scene::Scene corner = tests::cornerScene(4);
  for (const scene::Scene* scene : {&std::as_const(atrium), &corner}) {
    const double one = suitableRadius(scaled(*scene, 1, glm::dvec3(0)));
    for (const double scale : {1e-5, 0.03, 7.0, 1e3, 1e6}) {
      const double radius = suitableRadius(scaled(*scene, scale, scale * glm::dvec3(9, -40, 11)));
      EXPECT_NEAR(std::log(radius / (one * scale)), 0, std::log(1.3)) << scale << ": " << radius;
    }
  }
}

TEST(SceneLengths, TheAtriumKeepsTheTablesDefaults) {
  EXPECT_EQ(suitableRadius(scene::makeAtrium()), kUsualRadius);
}

// What the scene shows gives nearly the radius that its author chose.
TEST(SceneLengths, BuiltInScenesGetARadiusThatSuitsThem) {
  for (const scene::BuiltIn& one : scene::builtIns()) {
    EXPECT_NEAR(std::log(suitableRadius(one.make()) / one.radius), 0, std::log(2.5)) << one.name;
  }
}

TEST(SceneLengths, TheRadiusIsReadable) {
  for (int step = 0; step < 58; ++step) {
    const double scale = 1e-4 * std::pow(1.37, step);
    const double radius = suitableRadius(scaled(tests::cornerScene(3), scale, glm::dvec3(0)));
    EXPECT_EQ(radius, std::stod(fmt::format("{:.2g}", radius)));
  }
}

TEST(SceneLengths, ADepthPictureOfTheDefaultCameraGivesTheScenesRadius) {
  const scene::Scene atrium = scene::makeAtrium();
  const scene::Camera camera = scene::defaultCamera(atrium, 16.0 / 9);
  for (const uint32_t height : {45u, 90u, 720u}) {
    const image::Image depth = scene::sketchDepth(atrium, camera, height * 16 / 9, height);
    EXPECT_EQ(suitableRadius(depth, camera), suitableRadius(atrium)) << height;
  }
  image::Image sky{.width = 4, .height = 4, .channels = 1, .pixels = std::vector<float>(16, 0.0f)};
  EXPECT_EQ(suitableRadius(sky, camera), std::nullopt);
  sky.pixels[5] = 3;
  EXPECT_EQ(suitableRadius(sky, camera), std::nullopt) << "one point has no extent";
}

TEST(SceneLengths, AFewDistantSurfacesDoNotCount) {
  const scene::Camera camera;
  image::Image depth{
      .width = 100, .height = 50, .channels = 1, .pixels = std::vector<float>(5000, 2.0f)};
  const auto plain = suitableRadius(depth, camera);
  for (size_t i = 0; i < 100; ++i) depth.pixels[i * 49] = 1e6f;
  EXPECT_EQ(suitableRadius(depth, camera), plain);
}

TEST(SceneLengths, SharedScenesGetTheRadiiThatSuitThem) {
  constexpr struct {
    const char* scene;
    double least, most;  // metres
  } kScenes[] = {{"room", 0.3 / 2.5, 0.3 * 2.5},
                 {"trees", 0.4 / 2.5, 0.4 * 2.5},
                 {"machine", 0.12 / 2.5, 0.1 * 2.5},
                 {"street", 1 / 2.5, 2.5},
                 {"chess", 0.02 / 2.5, 0.02 * 2.5},
                 {"knight", 0.2 / 2.5, 0.2 * 2.5},
                 {"Sponza", 0.3, 0.8}};
  bool any = false;
  for (const auto& one : kScenes) {
    const std::string path = std::string(SHARED_FOLDER) + "/scenes/" + one.scene + ".glb";
    if (!std::filesystem::exists(path)) continue;
    any = true;
    const double radius = suitableRadius(scene::loadGltf(path));
    EXPECT_GE(radius, one.least) << one.scene;
    EXPECT_LE(radius, one.most) << one.scene;
  }
  if (!any) GTEST_SKIP() << "no scenes in " << SHARED_FOLDER;
}

TEST(SceneLengths, ScaleTheDefaultsOfLengthsThatNobodyHasSet) {
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  const std::string keys[] = {"ssao", "sspm"};
  effect::Selection selection(registry, keys);
  selection.set({.name = {.effect = "sspm", .key = "r0"}, .value = "7"});
  fitLengths(selection, 0.04);
  EXPECT_EQ(selection.values("ssao").text("radius"), "0.04");
  EXPECT_EQ(selection.values("sspm").text("paint_range"), "0.02");
  EXPECT_EQ(selection.values("sspm").text("splat_scale"), "0.0048");
  EXPECT_EQ(selection.values("sspm").text("r0"), "7");
  EXPECT_EQ(selection.values("ssao").text("bias"), "0");
  EXPECT_EQ(selection.values("ssao").text("thickness"), "1.25") << "in radii already";
  selection.values("sspm").reset("r0");
  EXPECT_EQ(selection.values("sspm").text("r0"), "0.08");
  // Another scene moves the lengths that follow.
  fitLengths(selection, kUsualRadius);
  const effect::Selection fresh(registry, keys);
  for (const std::string& key : keys) {
    EXPECT_TRUE(
        std::ranges::equal(selection.find(key)->values.all(), fresh.find(key)->values.all()));
  }
  // Lengths stay within the table's range.
  fitLengths(selection, 1e-9);
  EXPECT_EQ(selection.values("ssao").get("radius"), 1e-6);
}

TEST(SceneLengths, StatesAndSettingsFilesHoldOnlyThoseThatWereSet) {
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  const std::string keys[] = {"ssao"};
  effect::Selection selection(registry, keys);
  fitLengths(selection, 0.04);
  const effect::Selection::State following = selection.state();
  EXPECT_EQ(settingsToml(settingsOf(selection)).find("radius"), std::string::npos);
  selection.set({.name = {.effect = "ssao", .key = "radius"}, .value = "0.04"});
  EXPECT_NE(selection.state(), following);
  EXPECT_NE(settingsToml(settingsOf(selection)).find("radius = 0.04"), std::string::npos);
  // The restored length follows the next scene.
  EXPECT_TRUE(selection.restore(following).empty());
  EXPECT_EQ(selection.values("ssao").get("radius"), 0.04);
  fitLengths(selection, 3);
  EXPECT_EQ(selection.values("ssao").get("radius"), 3);
}

}  // namespace
}  // namespace grisaille::app
