// SPDX-License-Identifier: MIT
// Contents of the attachments, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/frame/renderer.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

class AttachmentsTest : public tests::BackendTest {
 protected:
  std::vector<image::Image> render(const scene::Scene& scene, const scene::Camera& camera,
                                   const std::vector<std::string>& outputs, uint32_t width = 32,
                                   uint32_t height = 24) {
    frame::Renderer renderer(device(), scene);
    renderer.render({.camera = camera,
                     .width = width,
                     .height = height,
                     .surface = frame::Surface::kBaseColour,
                     .outputs = outputs});
    std::vector<image::Image> images;
    for (const std::string& output : outputs) images.push_back(renderer.read(output));
    return images;
  }
};
GRISAILLE_ON_EVERY_DEVICE(AttachmentsTest);

// Largest relative error of a floor's depth against the pinhole's geometry at pixel centres, less
// the change of depth within `shift` pixels. The floor y = 0 is a square with sides of `size`
// metres around `middle`; more than `leastSeen` pixels must show it.
double floorError(const image::Image& depth, const scene::Camera& camera, const glm::dvec3& middle,
                  double size, double shift, uint32_t leastSeen) {
  const glm::dmat3 axes = scene::worldFromView(camera);
  const double half = std::tan(glm::radians(camera.fovyDegrees) / 2);
  const auto rayThrough = [&](double x, double y) {
    return axes * glm::dvec3(half * (2 * x - depth.width) / depth.height,
                             half * (depth.height - 2 * y) / depth.height, -1);
  };
  double worst = 0;
  uint32_t seen = 0;
  for (uint32_t y = 0; y < depth.height; ++y) {
    for (uint32_t x = 0; x < depth.width; ++x) {
      const glm::dvec3 ray = rayThrough(x + 0.5, y + 0.5);
      const double expected = ray.y < 0 ? -camera.eye.y / ray.y : 0;
      const glm::dvec3 hit = camera.eye + ray * expected;
      const double out = std::max(std::abs(hit.x - middle.x), std::abs(hit.z - middle.z));
      if (expected == 0) {
        EXPECT_EQ(depth.at(x, y), 0.0f) << x << " " << y;
      }
      if (expected == 0 || out > 0.49 * size) continue;
      // The camera does not roll: the floor's depth varies with y alone.
      const double moved = ray.y / rayThrough(x + 0.5, y + 0.5 - shift).y;
      worst = std::max(worst, std::abs(depth.at(x, y) / expected - 1) - std::abs(moved - 1));
      ++seen;
    }
  }
  EXPECT_GT(seen, leastSeen);
  return worst;
}

// A tile that is wholly in view: exact but for the shift by vertex snapping.
TEST_P(AttachmentsTest, ATilesDepthIsExact) {
  for (const glm::dvec3 eye : {glm::dvec3(0, 1.5, 0), glm::dvec3(12345.678, 1.5, -9876.5)}) {
    const scene::Camera camera = {.eye = eye, .target = eye + glm::dvec3(1, -1.5, -2)};
    scene::Scene scene = tests::floorScene(1);
    scene.instances[0].worldFromObject[3] = glm::dvec4(camera.target.x, 0, camera.target.z, 1);
    const image::Image depth = render(scene, camera, {"depth"}, 96, 72)[0];
    const double shift = snapping().movesDepth() ? 1.1 * snapping().depthShift : 0;
    EXPECT_LT(floorError(depth, camera, camera.target, 1, shift, 250), 2e-6);
  }
}

// A floor cut by the near plane and the picture's sides: clipping creates vertices hundreds of
// pixels outside the picture. Where depth is interpolated between snapped vertices, that shows:
// SwiftShader, which snaps to 1/16 pixel, is off by some hundredths, NVIDIA's GPUs, which snap to
// 1/256, by some thousandths.
TEST_P(AttachmentsTest, FloorDepthIsExact) {
  for (const glm::dvec3 eye : {glm::dvec3(0, 1.5, 0), glm::dvec3(12345.678, 1.5, -9876.5)}) {
    const scene::Camera camera = {.eye = eye, .target = eye + glm::dvec3(1, -0.5, -2)};
    scene::Scene scene = tests::floorScene();
    scene.instances[0].worldFromObject[3] = glm::dvec4(eye.x, 0, eye.z, 1);
    const image::Image depth = render(scene, camera, {"depth"})[0];
    if (snapping().movesDepth()) {
      const double allowed = 1.6 * snapping().halfStep();
      EXPECT_LT(floorError(depth, camera, eye, 4, 1.1 * snapping().depthShift, 50), allowed);
    } else {
      EXPECT_LT(floorError(depth, camera, eye, 100, 0, 300), 2e-6);
    }
  }
}

TEST_P(AttachmentsTest, NormalsAreWorldAxesAndFaceTheCamera) {
  scene::Scene scene = tests::floorScene();
  scene.materials[0].doubleSided = true;
  for (const double height : {2.0, -2.0}) {
    const scene::Camera camera = {.eye = glm::dvec3(0, height, 0),
                                  .target = glm::dvec3(0.5, 0, -0.1)};
    const image::Image normal = render(scene, camera, {"normal"})[0];
    const float up = height > 0 ? 1.0f : -1.0f;
    EXPECT_NEAR(normal.at(16, 12, 0), 0, 1e-3);
    EXPECT_NEAR(normal.at(16, 12, 1), up, 1e-3);
    EXPECT_NEAR(normal.at(16, 12, 2), 0, 1e-3);
  }
}

TEST_P(AttachmentsTest, MirroredAndStretchedInstancesKeepRightNormals) {
  for (const glm::dvec3 scale : {glm::dvec3(1), glm::dvec3(-1, 1, 1), glm::dvec3(1e-3, 3, 5)}) {
    scene::Scene scene;
    scene.materials.push_back({.name = "one side"});
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, 1, 0));
    // A slope that falls along +x; single-sided, to show wrong winding as a hole.
    tests::addQuad(scene, {glm::vec3(-9, 2.7f, 9), {9, -2.7f, 9}, {9, -2.7f, -9}, {-9, 2.7f, -9}},
                   normal);
    scene.instances[0].worldFromObject =
        glm::dmat4(glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z));
    const scene::Camera camera = {.eye = glm::dvec3(0, 4, 0), .target = glm::dvec3(0.0001, 0, 0)};
    const image::Image image = render(scene, camera, {"normal"}, 33, 33)[0];
    const glm::dvec3 expected = glm::normalize(glm::dvec3(normal) / scale);
    for (uint32_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(image.at(16, 16, c), expected[static_cast<int>(c)], 2e-3) << scale.x << " " << c;
    }
  }
}

TEST_P(AttachmentsTest, BackFacesOfOneSidedMaterialsAreNotDrawn) {
  const scene::Camera below = {.eye = glm::dvec3(0, -2, 0), .target = glm::dvec3(0.5, 0, -0.1)};
  const image::Image depth = render(tests::floorScene(), below, {"depth"})[0];
  for (const float value : depth.pixels) EXPECT_EQ(value, 0.0f);
}

TEST_P(AttachmentsTest, BaseColourComesFromTheMaterialAndTheSkyIsGrey) {
  scene::Scene scene = tests::floorScene();
  scene.materials[0].baseColor = glm::vec4(0.5f, 0.25f, 1, 1);
  const scene::Camera camera = {.eye = glm::dvec3(0, 2, 0), .target = glm::dvec3(0, 2, -1)};
  const auto images = render(scene, camera, {"base_colour", "color"});
  EXPECT_NEAR(images[0].at(16, 23, 0), 0.5, 0.005);
  EXPECT_NEAR(images[0].at(16, 23, 1), 0.25, 0.005);
  EXPECT_NEAR(images[0].at(16, 23, 2), 1, 0.005);
  EXPECT_NEAR(images[1].at(16, 23, 1), 0.25, 0.005);
  EXPECT_NEAR(images[1].at(16, 0, 1), frame::kGrey.g, 2e-4);
}

TEST_P(AttachmentsTest, SizesChangeFromFrameToFrame) {
  const scene::Scene scene = tests::cornerScene();
  const scene::Camera camera = {.eye = glm::dvec3(0, 1, 3), .target = glm::dvec3(0, 0.5, 0)};
  frame::Renderer renderer(device(), scene);
  const std::vector<std::string> outputs = {"depth", "normal", "color"};
  constexpr std::array<glm::uvec2, 5> kSizes = {
      glm::uvec2{1, 1}, {257, 129}, {1, 512}, {3, 3}, {64, 64}};
  for (const glm::uvec2 size : kSizes) {
    renderer.render({.camera = camera, .width = size.x, .height = size.y, .outputs = outputs});
    for (const std::string& output : outputs) {
      const image::Image image = renderer.read(output);
      EXPECT_EQ(image.width, size.x);
      EXPECT_EQ(image.height, size.y);
    }
    EXPECT_GT(renderer.read("depth").at(size.x / 2, size.y / 2), 0.0f);
  }
}

}  // namespace
}  // namespace grisaille
