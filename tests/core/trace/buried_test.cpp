// SPDX-License-Identifier: MIT
// Which triangles lie inside matter.
#include "core/trace/buried.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "core/trace/scene_matter.h"
#include "tests/support/scenes.h"

namespace grisaille::trace {
namespace {

using Sides = std::vector<bool>;  // of a box: -x, +x, -y, +y, -z, +z

glm::dmat4 boxAt(const glm::dvec3& centre, const glm::dvec3& half) {
  return glm::scale(glm::translate(glm::dmat4(1), centre), half);
}

// A block of 20 x 1 x 20 m whose top is at y = 0, and a box.
scene::Scene sceneWithBox(const glm::dvec3& centre, bool doubleSided = false) {
  scene::Scene scene;
  scene.materials.push_back({.name = "stone", .doubleSided = doubleSided});
  tests::addBox(scene, boxAt({0, -0.5, 0}, {10, 0.5, 10}));
  tests::addBox(scene, boxAt(centre, glm::dvec3(0.2)));
  scene::computeBounds(scene);
  return scene;
}

// Whether both triangles of each side of box number `box` are buried.
Sides buriedSides(const scene::Scene& scene, size_t box) {
  const std::vector<bool> all = buriedTriangles(scene);
  Sides sides;
  for (size_t i = 0; i < 6; ++i) {
    const size_t first = scene.primitives[6 * box + i].firstIndex / 3;
    EXPECT_EQ(all[first], all[first + 1]);
    sides.push_back(all[first]);
  }
  return sides;
}

const Sides kNone(6, false), kAll(6, true);

TEST(Buried, NothingOfABoxBesideAnother) {
  const scene::Scene scene = sceneWithBox({0, 0.5, 0});
  EXPECT_EQ(buriedSides(scene, 0), kNone);
  EXPECT_EQ(buriedSides(scene, 1), kNone);
}

TEST(Buried, TheBottomOfABoxThatSticksInTheGround) {
  for (const bool doubleSided : {false, true}) {
    const scene::Scene scene = sceneWithBox({3, 0.1, -2}, doubleSided);
    EXPECT_EQ(buriedSides(scene, 0), kNone);
    EXPECT_EQ(buriedSides(scene, 1), Sides({false, false, true, false, false, false}));
  }
}

TEST(Buried, TheBottomOfABoxThatStandsOnTheGround) {
  EXPECT_TRUE(buriedSides(sceneWithBox({3, 0.2, -2}), 1)[2]);
}

TEST(Buried, AllOfABoxBelowTheGround) {
  EXPECT_EQ(buriedSides(sceneWithBox({3, -0.5, -2}), 1), kAll);
}

// The underside of a rail that balusters hold, each narrower than the gaps between them.
TEST(Buried, NotASideThatOtherBodiesMeetInPlaces) {
  scene::Scene scene;
  scene.materials.push_back({.name = "stone"});
  tests::addBox(scene, boxAt({0, 0, 0}, {2, 0.1, 0.1}));
  for (int i = -2; i <= 2; ++i) tests::addBox(scene, boxAt({0.9 * i, -0.5, 0}, {0.15, 0.45, 0.1}));
  scene::computeBounds(scene);
  EXPECT_EQ(buriedSides(scene, 0), kNone);
}

TEST(Buried, NothingInARoomOrUnderASkyThatABoxDraws) {
  for (const bool inward : {false, true}) {
    scene::Scene scene = sceneWithBox({0, 0.5, 0});
    tests::addBox(scene, boxAt({0, 5, 0}, {40, 40, 40}));
    if (inward) {
      for (size_t side = 12; side < 18; ++side) {
        const scene::Primitive& own = scene.primitives[side];
        for (uint32_t i = 0; i < own.indexCount; i += 3) {
          std::swap(scene.indices[own.firstIndex + i], scene.indices[own.firstIndex + i + 1]);
        }
      }
    }
    scene::computeBounds(scene);
    EXPECT_EQ(buriedSides(scene, 1), kNone) << inward;
    EXPECT_EQ(buriedSides(scene, 2), kNone) << inward;
  }
}

TEST(Buried, ATriangleMustBeSoInEachInstance) {
  scene::Scene scene = sceneWithBox({3, -0.5, -2});
  for (size_t i = 6; i < 12; ++i) {
    scene::Instance other = scene.instances[i];
    other.worldFromObject = boxAt({0, 0.1, 0}, glm::dvec3(0.2));
    scene.instances.push_back(other);
  }
  EXPECT_EQ(buriedSides(scene, 1), Sides({false, false, true, false, false, false}));
}

TEST(Buried, AScenesMatterFindsTheSameInTheBackground) {
  const scene::Scene scene = sceneWithBox({3, 0.1, -2});
  SceneMatter now(scene), prepared(scene);
  prepared.prepareBuried();
  EXPECT_EQ(now.buried(), buriedTriangles(scene));
  EXPECT_EQ(prepared.buried(), now.buried());
}

}  // namespace
}  // namespace grisaille::trace
