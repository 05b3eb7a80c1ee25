// SPDX-License-Identifier: MIT
// The depth at which the visible matter ends, and that at which the next begins, compared with ray
// casts through every triangle, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "core/frame/renderer.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

constexpr uint32_t kWidth = 96, kHeight = 72;
constexpr double kNone = std::numeric_limits<double>::infinity();

// The value in the middle row of a picture, `x` metres right of the origin. The camera looks along
// -z.
float valueAt(const image::Image& drawn, const scene::Camera& camera, double x) {
  const double slope = std::tan(glm::radians(camera.fovyDegrees) / 2), half = drawn.height / 2.0;
  return drawn.at(static_cast<uint32_t>(drawn.width / 2.0 + x / (camera.eye.z * slope) * half),
                  drawn.height / 2);
}

class BackDepthTest : public tests::BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(BackDepthTest);

constexpr uint32_t kOneSided = 0, kTwoSided = 1, kTwoSidedBody = 2;  // materials

// Boxes, some of them mirrored or double-sided, and one-sided and two-sided cards, on an empty
// background.
scene::Scene mixedScene() {
  scene::Scene scene;
  scene.materials.push_back({.name = "one side"});
  scene.materials.push_back({.name = "two sides", .doubleSided = true});
  scene.materials.push_back({.name = "two sides of a body", .doubleSided = true});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 12; ++i) {
    glm::dmat4 placed(1);
    placed[0].x = (i % 2 == 0 ? 0.3 : -0.3) * (1.2 + unit(random));
    placed[1].y = 0.4;
    placed[2].z = 0.3 * (1.2 + unit(random));
    placed[2].x = 0.2 * unit(random);
    placed[3] = glm::dvec4(1.6 * unit(random), 1.1 * unit(random), 1.5 * unit(random), 1);
    if (i % 3 != 0) {
      tests::addBox(scene, placed, i % 3 == 1 ? kOneSided : kTwoSidedBody);
      continue;
    }
    tests::addQuad(scene, {glm::vec3(-1, -1, 0.2f), {1, -1, 0.5f}, {1, 1, -0.1f}, {-1, 1, -0.4f}},
                   {0, 0, 1}, i % 2 == 0 ? kTwoSided : kOneSided);
    scene.instances.back().worldFromObject = placed;
  }
  scene::computeBounds(scene);
  return scene;
}

struct Crossing {
  double depth;
  bool front, back;  // seen from the camera; matter ends here
};

// All crossings of a pixel's ray with the scene. The ray's end has view depth 1.
std::vector<Crossing> crossings(const scene::Scene& scene, glm::dvec3 eye, glm::dvec3 ray) {
  std::vector<Crossing> found;
  for (const scene::Instance& instance : scene.instances) {
    const scene::Primitive& primitive = scene.primitives[instance.primitive];
    const bool two = primitive.material != kOneSided, sheet = primitive.material == kTwoSided;
    const bool mirrors = glm::determinant(glm::dmat3(instance.worldFromObject)) < 0;
    for (uint32_t i = 0; i < primitive.indexCount; i += 3) {
      glm::dvec3 p[3];
      for (uint32_t k = 0; k < 3; ++k) {
        const glm::vec3 at = scene.positions[scene.indices[primitive.firstIndex + i + k]];
        p[k] = glm::dvec3(instance.worldFromObject * glm::dvec4(at, 1)) - eye;
      }
      // Solve one linear system for the barycentric coordinates and the depth.
      const glm::dvec3 x = glm::inverse(glm::dmat3(p[1] - p[0], p[2] - p[0], -ray)) * -p[0];
      if (x.x < 0 || x.y < 0 || x.x + x.y > 1 || x.z <= 0) continue;
      const bool faces = (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), ray) < 0) != mirrors;
      found.push_back({.depth = x.z, .front = faces || two, .back = !faces || sheet});
    }
  }
  return found;
}

// Expected result for a ray with view depth 1 at its end: whether it hits a surface, and the depth
// of the next surface that faces away, or 0, and of the next behind it that faces the camera, or 0.
struct Expected {
  bool front = false;
  double back = 0, next = 0;
};
Expected expectedOn(const scene::Scene& scene, const glm::dvec3& eye, const glm::dvec3& ray) {
  const std::vector<Crossing> all = crossings(scene, eye, ray);
  double front = kNone, back = kNone;
  for (const Crossing& c : all) front = c.front ? std::min(front, c.depth) : front;
  for (const Crossing& c : all) {
    if (c.back && c.depth >= front * (1 - 1e-7)) back = std::min(back, c.depth);
  }
  if (front == kNone) return {};
  if (back == kNone) return {.front = true};
  double next = kNone;
  for (const Crossing& c : all) {
    if (c.front && c.depth > back * (1 + 1e-6)) next = std::min(next, c.depth);
  }
  return {.front = true, .back = back, .next = next < kNone ? next : 0};
}

// A box at half size, a banner and a wall.
TEST_P(BackDepthTest, ThicknessIsThatOfTheBody) {
  scene::Scene scene;
  scene.materials.push_back({.name = "wall"});
  scene.materials.push_back({.name = "banner", .doubleSided = true});
  tests::addBox(scene, glm::scale(glm::dmat4(1), glm::dvec3(0.5)));
  const auto quad = [&](float x, uint32_t material) {
    tests::addQuad(scene, {glm::vec3(x, -1, 0), {x + 1, -1, 0}, {x + 1, 1, 0}, {x, 1, 0}},
                   {0, 0, 1}, material);
  };
  quad(-2, 0);
  quad(1, 1);
  const scene::Camera camera = {.eye = glm::dvec3(0, 0, 4), .target = glm::dvec3(0)};
  frame::Renderer renderer(device(), scene);
  const std::vector<std::string> outputs = {"thickness", "base_colour", "facet_normal", "normal"};
  renderer.render({.camera = camera, .width = 160, .height = 90, .outputs = outputs});
  const image::Image drawn = renderer.read("thickness");
  const auto at = [&](double x) { return valueAt(drawn, camera, x); };
  EXPECT_NEAR(at(0), 2.0 / 3, 1e-3);
  EXPECT_EQ(at(-1.5), -1);
  EXPECT_EQ(at(1.5), 0);
  EXPECT_EQ(drawn.at(2, 2), 0);
  EXPECT_EQ(renderer.read("normal").at(80, 45, 2), 1);
}

// A cube that becomes a bar of 2 x 0.2 x 0.4: the mean chord is that of the bar.
TEST_P(BackDepthTest, ThicknessIsThatOfTheStretchedBody) {
  scene::Scene scene;
  scene.materials.push_back({.name = "bar"});
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.5, glm::dvec3(1, 0, 0));
  tests::addBox(scene, glm::scale(turned, glm::dvec3(1, 0.1, 0.2)));
  const scene::Camera camera = {.eye = glm::dvec3(0, 0, 4), .target = glm::dvec3(0)};
  frame::Renderer renderer(device(), scene);
  const std::vector<std::string> outputs = {"thickness"};
  renderer.render({.camera = camera, .width = 160, .height = 90, .outputs = outputs});
  const double volume = 2 * 0.2 * 0.4, surface = 2 * (2 * 0.2 + 0.2 * 0.4 + 0.4 * 2);
  EXPECT_NEAR(renderer.read("thickness").at(80, 45), 4 * volume / surface, 1e-4);
}

// Rows of surfaces, seen from the front: boxes, sheets, and walls of one side.
TEST_P(BackDepthTest, NextDepthIsThatOfTheSurfaceBehindTheBack) {
  scene::Scene scene;
  scene.materials.push_back({.name = "one side"});
  scene.materials.push_back({.name = "two sides", .doubleSided = true});
  const auto quad = [&](float x, float z, uint32_t material) {
    tests::addQuad(
        scene, {glm::vec3(x - 0.4f, -1, z), {x + 0.4f, -1, z}, {x + 0.4f, 1, z}, {x - 0.4f, 1, z}},
        {0, 0, 1}, material);
  };
  const auto box = [&](double x, double z) {
    const glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(x, 0, z));
    tests::addBox(scene, glm::scale(place, glm::dvec3(0.3, 0.3, 0.25)));
  };
  box(-2, 1);  // before a box
  box(-2, 0);
  quad(-1, 1, 1);  // a sheet before a sheet
  quad(-1, 0.5f, 1);
  box(0, 1);      // before nothing
  quad(1, 1, 1);  // a sheet before a wall
  quad(1, 0, 0);
  quad(2, 1, 0);  // walls: no back
  quad(2, 0, 0);
  scene::computeBounds(scene);
  const scene::Camera camera = {
      .eye = glm::dvec3(0, 0, 1000), .target = glm::dvec3(0), .fovyDegrees = 0.2};
  frame::Renderer renderer(device(), scene);
  const std::vector<std::string> outputs = {"next_depth"};
  renderer.render({.camera = camera, .width = 160, .height = 90, .outputs = outputs});
  const image::Image drawn = renderer.read("next_depth");
  const auto at = [&](double x) { return valueAt(drawn, camera, x); };
  EXPECT_NEAR(at(-2), 999.75, 1e-3);
  EXPECT_NEAR(at(-1), 999.5, 1e-3);
  EXPECT_EQ(at(0), 0);
  EXPECT_NEAR(at(1), 1000, 1e-3);
  EXPECT_EQ(at(2), 0);
}

// A peg that sticks in a block, and one that ends in front of another block.
TEST_P(BackDepthTest, MatterEndsBehindTheBodyThatAnotherSticksIn) {
  scene::Scene scene;
  scene.materials.push_back({.name = "wood"});
  const auto box = [&](const glm::dvec3& centre, const glm::dvec3& half) {
    tests::addBox(scene, glm::scale(glm::translate(glm::dmat4(1), centre), half));
  };
  for (const double x : {-2.0, 2.0}) box({x, 0, 0}, {1, 1, 0.5});
  box({-2, 0, 0.5}, {0.2, 0.2, 0.3});
  box({2, 0, 1}, {0.2, 0.2, 0.3});
  scene::computeBounds(scene);
  const scene::Camera camera = {
      .eye = glm::dvec3(0, 0, 1000), .target = glm::dvec3(0), .fovyDegrees = 0.2};
  frame::Renderer renderer(device(), scene);
  const std::vector<std::string> outputs = {"back_depth"};
  renderer.render({.camera = camera, .width = 160, .height = 90, .outputs = outputs});
  const image::Image drawn = renderer.read("back_depth");
  const auto at = [&](double x) { return valueAt(drawn, camera, x); };
  EXPECT_NEAR(at(-2), 1000.5, 1e-3);
  EXPECT_NEAR(at(2), 999.3, 1e-3);
}

// A pixel's depth is the depth at its centre. Where the rasteriser snaps vertices coarsely, it may
// be that of a ray close to the centre.
TEST_P(BackDepthTest, IsTheNextSurfaceThatFacesAwayAndNextDepthTheOneBehindIt) {
  const scene::Scene scene = mixedScene();
  const scene::Camera camera = {.eye = glm::dvec3(0.7, 0.4, 4), .target = glm::dvec3(0)};
  frame::Renderer renderer(device(), scene);
  const std::vector<std::string> outputs = {"back_depth", "next_depth", "depth"};
  renderer.render({.camera = camera, .width = kWidth, .height = kHeight, .outputs = outputs});
  const image::Image drawn = renderer.read("back_depth"), next = renderer.read("next_depth");
  const glm::dmat3 axes = scene::worldFromView(camera);
  const double slope = std::tan(glm::radians(camera.fovyDegrees) / 2);
  std::vector<double> shifts;
  if (snapping().movesDepth()) shifts = {-snapping().halfStep(), snapping().halfStep()};
  size_t with = 0, without = 0, wrong = 0, followed = 0, wrongNext = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const auto expectedAt = [&](double right, double down) {
        const double u = x + 0.5 + right, v = y + 0.5 + down;
        return expectedOn(scene, camera.eye,
                          axes * glm::dvec3((2 * u - kWidth) / kHeight * slope,
                                            (1 - 2 * v / kHeight) * slope, -1));
      };
      const Expected expected = expectedAt(0, 0);
      (expected.back > 0 ? with : without) += expected.front ? 1 : 0;
      followed += expected.next > 0 ? 1 : 0;
      double least = expected.back, most = expected.back;
      double leastNext = expected.next, mostNext = expected.next;
      for (const double right : shifts) {
        for (const double down : shifts) {
          const Expected other = expectedAt(right, down);
          least = std::min(least, other.back);
          most = std::max(most, other.back);
          leastNext = std::min(leastNext, other.next);
          mostNext = std::max(mostNext, other.next);
        }
      }
      wrong += drawn.at(x, y) < least - 1e-4 || drawn.at(x, y) > most + 1e-4 ? 1 : 0;
      wrongNext += next.at(x, y) < leastNext - 1e-4 || next.at(x, y) > mostNext + 1e-4 ? 1 : 0;
    }
  }
  EXPECT_GT(with, 1000u);
  EXPECT_GT(without, 100u);
  EXPECT_GT(followed, 200u);
  EXPECT_LE(wrong, kWidth * kHeight / 200u);  // pixels on edges
  EXPECT_LE(wrongNext, kWidth * kHeight / 100u);
}

}  // namespace
}  // namespace grisaille
