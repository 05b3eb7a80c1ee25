// SPDX-License-Identifier: MIT
// The floor that a claim puts under its scene.
#include "lab/claims/floor.h"

#include <gtest/gtest.h>

#include "core/scene/rig.h"
#include "tests/program/run.h"
#include "tests/support/animated_gltf.h"

namespace grisaille::lab::claims {
namespace {

TEST(Floor, LiesUnderTheSceneInEveryPose) {
  const tests::TemporaryFolder folder;
  scene::Scene scene = scene::loadScene(folder.write("moving.glb", tests::animatedGlb()));
  const scene::Bounds before = scene.bounds;
  const size_t count = scene.instances.size();
  addFloor(scene);
  ASSERT_EQ(scene.instances.size(), count + 1);
  EXPECT_EQ(scene.bounds.min.y, before.min.y);
  EXPECT_EQ(scene.bounds.max.y, before.max.y);
  EXPECT_GT(scene.bounds.max.x - scene.bounds.min.x, 9 * (before.max.x - before.min.x));
  const glm::dmat4 place = scene.instances.back().worldFromObject;
  const auto moving = scene::movingInstances(scene);
  EXPECT_FALSE(moving.back());
  scene::pose(scene, {.animation = 0, .seconds = 1});
  EXPECT_EQ(scene.instances.back().worldFromObject, place);
}

TEST(Floor, OfASceneAtRest) {
  scene::Scene scene = scene::makeAtrium();
  const size_t triangles = scene::triangleCount(scene);
  addFloor(scene);
  EXPECT_EQ(scene::triangleCount(scene), triangles + 2);
}

}  // namespace
}  // namespace grisaille::lab::claims
