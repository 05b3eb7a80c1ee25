// SPDX-License-Identifier: MIT
#include "app/study/random_cameras.h"

#include <gtest/gtest.h>

#include "core/trace/ray_tracer.h"

namespace grisaille::app::study {
namespace {

TEST(RandomCameras, SeeTheSceneFromInside) {
  const scene::Scene scene = scene::makeAtrium();
  const trace::RayTracer tracer(scene, glm::dvec3(0));
  for (const uint32_t seed : {1u, 2u}) {
    const auto cameras = randomCameras(scene, scene::atriumCamera(), 6, seed);
    ASSERT_EQ(cameras.size(), 6u);
    for (const scene::Camera& camera : cameras) {
      SCOPED_TRACE(scene::cameraJson(camera));
      EXPECT_NO_THROW(scene::validate(camera));
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
  const auto first = randomCameras(scene, like, 3, 5), again = randomCameras(scene, like, 3, 5);
  const auto other = randomCameras(scene, like, 3, 6);
  ASSERT_EQ(first.size(), 3u);
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(scene::cameraJson(first[i]), scene::cameraJson(again[i]));
    EXPECT_NE(scene::cameraJson(first[i]), scene::cameraJson(other[i]));
    EXPECT_EQ(first[i].fovyDegrees, like.fovyDegrees);
  }
}

TEST(RandomCameras, AreFewerWhereNothingIsToBeSeen) {
  // One triangle: hardly any direction hits it.
  scene::Scene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  scene.normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
  scene.texCoords = {{0, 0}, {0, 0}, {0, 0}};
  scene.indices = {0, 1, 2};
  scene.materials.emplace_back();
  scene.primitives.push_back({.firstIndex = 0, .indexCount = 3, .material = 0});
  scene.instances.emplace_back();
  scene.bounds = {.min = {0, 0, 0}, .max = {1, 0.5, 1}};
  EXPECT_TRUE(randomCameras(scene, scene::atriumCamera(), 2, 1).empty());
}

}  // namespace
}  // namespace grisaille::app::study
