// SPDX-License-Identifier: MIT
#include "app/study/random_cameras.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <ranges>

#include "core/trace/ray_tracer.h"
#include "tests/program/run.h"
#include "tests/support/scenes.h"

namespace grisaille::app::study {
namespace {

// Adds a box on the floor, with its faces outwards, or inwards as the walls of a room.
void addBox(scene::Scene& scene, glm::vec3 low, glm::vec3 high, bool inwards) {
  const auto quad = [&](std::array<glm::vec3, 4> corners) {
    if (inwards) std::ranges::reverse(corners);
    const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    tests::addQuad(scene, corners, glm::normalize(normal));
  };
  const auto [x0, y0, z0] = std::array{low.x, low.y, low.z};
  const auto [x1, y1, z1] = std::array{high.x, high.y, high.z};
  quad({glm::vec3{x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1}});
  quad({glm::vec3{x1, y0, z0}, {x0, y0, z0}, {x0, y1, z0}, {x1, y1, z0}});
  quad({glm::vec3{x1, y0, z1}, {x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}});
  quad({glm::vec3{x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, {x0, y1, z0}});
  quad({glm::vec3{x0, y1, z1}, {x1, y1, z1}, {x1, y1, z0}, {x0, y1, z0}});
  quad({glm::vec3{x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1}});
}

scene::Scene boxScene(glm::vec3 low, glm::vec3 high, bool inwards) {
  scene::Scene scene;
  scene.materials.push_back({.name = "white"});
  addBox(scene, low, high, inwards);
  return scene;
}

std::vector<glm::dvec3> manyDirections() {
  std::vector<glm::dvec3> all;
  for (int i = 0; i < 500; ++i) {
    const double y = 1 - (2 * i + 1) / 500.0, r = std::sqrt(1 - y * y), angle = 2.4 * i;
    all.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
  }
  return all;
}

// Checks what a user sees from each camera, with a finer picture and more rays than the search.
void expectViews(const scene::Scene& scene, const std::vector<scene::Camera>& cameras,
                 double radius) {
  const trace::RayTracer tracer(scene, (scene.bounds.min + scene.bounds.max) / 2.0);
  const double diagonal = glm::length(scene.bounds.max - scene.bounds.min);
  for (const scene::Camera& camera : cameras) {
    SCOPED_TRACE(scene::cameraJson(camera));
    EXPECT_NO_THROW(scene::validate(camera));
    const trace::Surroundings around = tracer.surroundings(camera.eye, manyDirections());
    EXPECT_LT(around.winding, 0.6) << "it is inside a body";
    EXPECT_LT(around.backs, 0.7 * around.met);
    EXPECT_GT(around.nearest, 0.005 * diagonal) << "the lens is against a wall";
    const auto hits = tracer.castPrimary(camera, 96, 54);
    const auto seen = tracer.ambientOcclusion(hits, radius, 64, 7);
    EXPECT_GE(occludedShare(trace::visibilityImage(seen, 96, 54)), 1.0 / 3);
    const auto near = std::ranges::count_if(hits, [&](const trace::Hit& hit) {
      return hit.viewDepth > 0 && hit.viewDepth < 0.03 * diagonal;
    });
    EXPECT_LT(near * 10, std::ssize(hits) * 6);
  }
}

TEST(RandomCameras, SeeTheAtriumFromInside) {
  const scene::Scene scene = scene::makeAtrium();
  const trace::RayTracer tracer(scene, glm::dvec3(0));
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const auto cameras =
        randomCameras(scene, {.like = scene::atriumCamera(), .count = 4, .seed = seed});
    ASSERT_EQ(cameras.size(), 4u);
    expectViews(scene, cameras, 0.5);
    for (const scene::Camera& camera : cameras) {
      EXPECT_TRUE(glm::all(glm::greaterThan(camera.eye, scene.bounds.min)));
      EXPECT_TRUE(glm::all(glm::lessThan(camera.eye, scene.bounds.max)));
      const auto hits = tracer.castPrimary(camera, 160, 90);
      size_t seen = 0, near = 0;
      for (const trace::Hit& hit : hits) {
        seen += hit.viewDepth > 0;
        near += hit.viewDepth > 0 && hit.viewDepth < 0.1;
      }
      EXPECT_GT(seen * 10, hits.size() * 7);
      EXPECT_LT(near * 100, hits.size());
    }
  }
}

TEST(RandomCameras, AreTheSameForASeedAndOthersForAnother) {
  const scene::Scene scene = scene::makeAtrium();
  const scene::Camera like = scene::atriumCamera();
  const auto first = randomCameras(scene, {.like = like, .seed = 5}),
             again = randomCameras(scene, {.like = like, .seed = 5}),
             other = randomCameras(scene, {.like = like, .seed = 6});
  ASSERT_EQ(first.size(), 3u);
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(scene::cameraJson(first[i]), scene::cameraJson(again[i]));
    EXPECT_NE(scene::cameraJson(first[i]), scene::cameraJson(other[i]));
    EXPECT_EQ(first[i].fovyDegrees, like.fovyDegrees);
  }
}

// A closed box on a floor: every eye is outside the box and above the floor.
TEST(RandomCameras, SeeABodyFromOutside) {
  scene::Scene scene = tests::floorScene(6);
  const glm::vec3 low(-1, 0, -1), high(1, 2, 1);
  addBox(scene, low, high, false);
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const auto cameras = randomCameras(scene, {.radius = 1, .seed = seed});
    ASSERT_EQ(cameras.size(), 3u);
    expectViews(scene, cameras, 1);
    for (const scene::Camera& camera : cameras) {
      EXPECT_GT(camera.eye.y, 0);
      EXPECT_FALSE(glm::all(glm::greaterThan(camera.eye, glm::dvec3(low))) &&
                   glm::all(glm::lessThan(camera.eye, glm::dvec3(high))));
    }
  }
}

TEST(RandomCameras, SeeARoomFromInside) {
  const glm::vec3 low(-2, 0, -1.5f), high(2, 2.5f, 1.5f);
  const scene::Scene scene = boxScene(low, high, true);
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const auto cameras = randomCameras(scene, {.radius = 1, .seed = seed});
    ASSERT_EQ(cameras.size(), 3u);
    expectViews(scene, cameras, 1);
    for (const scene::Camera& camera : cameras) {
      EXPECT_TRUE(glm::all(glm::greaterThan(camera.eye, glm::dvec3(low))) &&
                  glm::all(glm::lessThan(camera.eye, glm::dvec3(high))));
    }
  }
}

TEST(RandomCameras, AreNoneWhereNothingIsOccluded) {
  const scene::Camera like = scene::atriumCamera();
  EXPECT_TRUE(randomCameras(tests::floorScene(), {.like = like}).empty());
  // Nothing occludes the outside of a box, and its inside is no place to look from.
  const scene::Scene box = boxScene(glm::vec3(-1), glm::vec3(1), false);
  EXPECT_TRUE(randomCameras(box, {.like = like}).empty());
  // In a room, a radius of a millimetre reaches no occluder.
  const scene::Scene room = boxScene(glm::vec3(-2), glm::vec3(2), true);
  EXPECT_TRUE(randomCameras(room, {.like = like, .radius = 0.001}).empty());
}

TEST(RandomCameras, SeeTheSharedScenes) {
  if (tests::sponza().empty()) GTEST_SKIP() << tests::kNoSponza;
  const auto folder = std::filesystem::path(tests::sponza()).parent_path();
  const std::pair<const char*, double> scenes[] = {
      {"Sponza.glb", 0.5}, {"room.glb", 0.3},   {"trees.glb", 0.4}, {"machine.glb", 0.12},
      {"street.glb", 1},   {"chess.glb", 0.02}, {"knight.glb", 0.2}};
  for (const auto& [name, radius] : scenes) {
    if (!std::filesystem::exists(folder / name)) continue;
    SCOPED_TRACE(name);
    const scene::Scene scene = scene::loadGltf(folder / name);
    for (const uint32_t seed : {1u, 2u, 3u}) {
      const auto cameras =
          randomCameras(scene, {.like = scene::Camera{}, .radius = radius, .seed = seed});
      EXPECT_EQ(cameras.size(), 3u);
      expectViews(scene, cameras, radius);
    }
  }
}

}  // namespace
}  // namespace grisaille::app::study
