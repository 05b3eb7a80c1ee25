// SPDX-License-Identifier: MIT
#include "core/scene/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/base/error.h"
#include "core/scene/depth_sketch.h"
#include "core/scene/view.h"
#include "tests/support/scene_files.h"

namespace grisaille::scene {
namespace {

// Adds a box from -0.5 to 0.5 times `extent`, with its faces turned outward or inward.
void addBox(Scene& scene, const glm::vec3& extent, const glm::dmat4& place, bool inward = false) {
  const auto base = static_cast<uint32_t>(scene.positions.size());
  for (uint32_t i = 0; i < 8; ++i) {
    scene.positions.emplace_back(glm::vec3(i & 1u, i >> 1u & 1u, i >> 2u & 1u) * extent -
                                 0.5f * extent);
  }
  scene.normals.resize(scene.positions.size(), glm::vec3(0, 1, 0));
  scene.texCoords.resize(scene.positions.size());
  const uint32_t corners[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                              2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  const auto first = static_cast<uint32_t>(scene.indices.size());
  for (uint32_t i = 0; i < 36; i += 3) {
    for (uint32_t k = 0; k < 3; ++k) {
      scene.indices.push_back(base + corners[i + (inward ? 2 - k : k)]);
    }
  }
  scene.primitives.push_back({.firstIndex = first, .indexCount = 36, .material = 0});
  scene.instances.push_back(
      {.primitive = static_cast<uint32_t>(scene.primitives.size() - 1), .worldFromObject = place});
}

glm::dmat4 placed(double scale, const glm::dvec3& at) {
  glm::dmat4 place(scale);
  place[3] = glm::dvec4(at, 1);
  return place;
}

Scene boxScene(const glm::vec3& extent, double scale = 1, const glm::dvec3& at = glm::dvec3(0)) {
  Scene scene;
  scene.materials.resize(1);
  addBox(scene, extent, placed(scale, at));
  computeBounds(scene);
  return scene;
}

// A room of 6 x 3 x 5 m with small boxes on its floor.
Scene roomScene(double scale) {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].doubleSided = true;
  addBox(scene, {6, 3, 5}, placed(scale, glm::dvec3(0)), true);
  for (int i = 0; i < 30; ++i) {
    const glm::dvec3 at(i % 6 * 0.8 - 2, -1.2, i / 6 * 0.8 - 1.6);
    addBox(scene, glm::vec3(0.3f, 0.6f, 0.3f), placed(scale, scale * at));
  }
  computeBounds(scene);
  return scene;
}

double coveredBy(const Scene& scene, const Camera& camera, double aspect) {
  const image::Image depth =
      sketchDepth(scene, camera, static_cast<uint32_t>(std::max(1.0, 90 * aspect)), 90);
  const auto seen = std::ranges::count_if(depth.pixels, [](float metres) { return metres > 0; });
  return static_cast<double>(seen) / static_cast<double>(depth.pixels.size());
}

// Checks that the camera is valid, survives its file, and holds every vertex between its near plane
// and the picture's borders. Returns the greatest share of half the picture that a vertex reaches.
double expectFramed(const Scene& scene, const Camera& camera, double aspect) {
  EXPECT_NO_THROW(validate(camera));
  EXPECT_EQ(parseCamera(cameraJson(camera), "camera").eye, camera.eye);
  const glm::dmat4 clip = clipFromView(viewOf(camera, {std::lround(9000 * aspect), 9000}));
  const glm::dmat3 view = glm::transpose(worldFromView(camera));
  double reach = 0;
  forEachFace(scene, camera.eye, [&](const Face& face) {
    for (const glm::dvec3& corner : face.corners) {
      const glm::dvec4 p = clip * glm::dvec4(view * corner, 1);
      EXPECT_GT(p.w, camera.nearPlane);
      reach = std::max({reach, std::abs(p.x / p.w), std::abs(p.y / p.w)});
    }
  });
  EXPECT_LE(reach, 1);
  return reach;
}

TEST(Framing, HoldsModelsOfAnySizeShapeAndPlace) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int round = 0; round < 60; ++round) {
    const double scale = std::pow(10, -6 + 15 * share(random));
    const auto side = [&] { return static_cast<float>(std::pow(10, -2 * share(random))); };
    const glm::vec3 extent = round % 4 == 0   ? glm::vec3(1, 1, 1)
                             : round % 4 == 1 ? glm::vec3(0.01f, 1, 0.01f)
                             : round % 4 == 2 ? glm::vec3(1, 0, side())
                                              : glm::vec3(side(), side(), side());
    // From the origin to a million times the model's size away.
    const double away = scale * std::pow(10, 6 * share(random)) * (round % 2);
    const Scene scene = boxScene(extent, scale, away * glm::dvec3(0.6, -0.64, 0.48));
    for (const double aspect : {0.5, 1.0, 16.0 / 9, 4.0}) {
      SCOPED_TRACE(testing::Message() << "round " << round << ", scale " << scale << ", away "
                                      << away << ", aspect " << aspect);
      const Camera camera = framingCamera(scene, aspect);
      EXPECT_GT(expectFramed(scene, camera, aspect), 0.9);
      EXPECT_GT(coveredBy(scene, camera, aspect), 0);
    }
  }
}

TEST(Framing, CoversMuchOfThePicture) {
  for (const glm::vec3 extent : {glm::vec3(1), glm::vec3(2, 1, 1), glm::vec3(1, 1, 3),
                                 glm::vec3(1, 0, 1), glm::vec3(1, 1, 0), glm::vec3(3, 0.5, 3)}) {
    for (const double aspect : {4.0 / 3, 16.0 / 9}) {
      const Scene scene = boxScene(extent);
      EXPECT_GT(coveredBy(scene, framingCamera(scene, aspect), aspect), 0.35)
          << extent.x << " x " << extent.y << " x " << extent.z << ", aspect " << aspect;
    }
  }
}

TEST(Framing, FollowsScaleAndPlace) {
  const Scene one = boxScene({1, 2, 3});
  const Camera camera = framingCamera(one, 1.5);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e9}) {
    const glm::dvec3 at = 100 * scale * glm::dvec3(1, -2, 3);
    const Camera scaled = framingCamera(boxScene({1, 2, 3}, scale, at), 1.5);
    const double error = 1e-6 * scale;
    EXPECT_LT(glm::length(scaled.eye - (scale * camera.eye + at)), error) << scale;
    EXPECT_LT(glm::length(scaled.target - (scale * camera.target + at)), error) << scale;
    EXPECT_NEAR(scaled.nearPlane, scale * camera.nearPlane, error);
  }
}

TEST(Framing, LooksAtTheSideThatHasSurface) {
  // A wall without a back, seen from its front wherever that is.
  for (const double turn : {0.0, 90.0, 180.0, 270.0}) {
    Scene scene;
    scene.materials.resize(1);
    scene.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    scene.normals.resize(4, glm::vec3(0, 0, 1));
    scene.texCoords.resize(4);
    scene.indices = {0, 1, 2, 0, 2, 3};
    scene.primitives = {{.firstIndex = 0, .indexCount = 6, .material = 0}};
    glm::dmat4 place(1);
    const double a = glm::radians(turn);
    place[0] = {std::cos(a), 0, -std::sin(a), 0};
    place[2] = {std::sin(a), 0, std::cos(a), 0};
    scene.instances = {{.primitive = 0, .worldFromObject = place}};
    computeBounds(scene);
    EXPECT_GT(coveredBy(scene, framingCamera(scene, 1), 1), 0.4) << turn;
  }
}

TEST(Framing, AnInteriorIsSeenFromWithin) {
  for (const double scale : {1e-3, 1.0, 1e4}) {
    const Scene scene = roomScene(scale);
    const Camera camera = framingCamera(scene, 16.0 / 9);
    EXPECT_NO_THROW(validate(camera));
    EXPECT_TRUE(glm::all(glm::greaterThan(camera.eye, scene.bounds.min)));
    EXPECT_TRUE(glm::all(glm::lessThan(camera.eye, scene.bounds.max)));
    EXPECT_GT(coveredBy(scene, camera, 16.0 / 9), 0.97);
  }
}

TEST(Framing, ASceneWithoutExtentHasAValidCamera) {
  for (const glm::dvec3 at : {glm::dvec3(0), glm::dvec3(1e9, 0, 0), glm::dvec3(3, -7e12, 1)}) {
    const Scene scene = boxScene(glm::vec3(0), 1, at);
    EXPECT_NO_THROW(validate(framingCamera(scene, 1)));
  }
  EXPECT_NO_THROW(validate(framingCamera(Scene{}, 1)));
}

// An eye within the bounds does not look through a wall whose back is not drawn: shots from there
// would start outside of the room.
void expectInTheRoom(const Scene& scene, const Camera& camera, const std::string& name) {
  if (!glm::all(glm::greaterThan(camera.eye, scene.bounds.min)) ||
      !glm::all(glm::lessThan(camera.eye, scene.bounds.max))) {
    return;
  }
  DepthSketch sketch(camera, 160, 90);
  forEachFace(scene, glm::dvec3(0), [&](const Face& face) { sketch.draw(face); });
  EXPECT_LE(sketch.throughBacks(), 0.03) << name;
}

TEST(Framing, AnEyeInsideStandsInTheRoom) {
  // Rooms whose walls have no back, beside boxes that make the bounds larger than the room.
  for (const double away : {0.5, 1.0, 1.5, 3.0}) {
    Scene scene;
    scene.materials.resize(1);
    addBox(scene, {6, 3, 5}, glm::dmat4(1), true);
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 at(i % 8 * 0.7 - 2.5, -1.3, i / 8 * 0.9 - 1.8);
      addBox(scene, {0.3f, 0.4f, 0.3f}, placed(1, at));
    }
    for (const int side : {-1, 1}) {
      addBox(scene, {1, 1, 1}, placed(1, {side * (3 + away), 0, side * (2.5 + away)}));
    }
    computeBounds(scene);
    expectInTheRoom(scene, framingCamera(scene, 16.0 / 9), "away " + std::to_string(away));
  }
}

TEST(Framing, FilesCoverAThirdOfThePicture) {
  std::vector<double> covered;
  for (const std::string& file : tests::sceneFilesBelow(
           {SHARED_FOLDER "/models", SHARED_FOLDER "/scenes", STUDIES "/scenes"})) {
    try {
      const Scene scene = loadGltf(file);
      const Camera camera = framingCamera(scene, 16.0 / 9);
      covered.push_back(coveredBy(scene, camera, 16.0 / 9));
      // Thin shapes cover little, whatever the direction.
      EXPECT_GT(covered.back(), 0.1) << file;
      expectInTheRoom(scene, camera, file);
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kSceneEmpty) << error.what();
    }
  }
  ASSERT_FALSE(covered.empty());
  std::ranges::sort(covered);
  EXPECT_GE(covered[covered.size() / 2], 0.35);
}

}  // namespace
}  // namespace grisaille::scene
