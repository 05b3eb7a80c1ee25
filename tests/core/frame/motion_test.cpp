// SPDX-License-Identifier: MIT
// Motion vectors, compared with projections in double precision, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/frame/renderer.h"
#include "core/frame/view_block.h"
#include "core/scene/rig.h"
#include "core/trace/ray_tracer.h"
#include "tests/support/devices.h"
#include "tests/support/moving_scenes.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

struct Seen {
  image::Image motion, depth;
};

class MotionTest : public tests::BackendTest {
 protected:
  static constexpr uint32_t kWidth = 160, kHeight = 90;

  static Seen draw(frame::Renderer& renderer, const scene::Camera& camera, uint32_t width = kWidth,
                   uint32_t height = kHeight) {
    const std::vector<std::string> outputs = {"motion", "depth"};
    renderer.render({.camera = camera, .width = width, .height = height, .outputs = outputs});
    return {.motion = renderer.read("motion"), .depth = renderer.read("depth")};
  }

  // Draws both scenes, one after the other, with one renderer.
  void expectMotion(const scene::Scene& then, const scene::Camera& thenCamera,
                    const scene::Scene& now, const scene::Camera& camera,
                    double leastMoving = 0.01) {
    scene::Scene scene = then;
    frame::Renderer renderer(device(), scene);
    draw(renderer, thenCamera);
    scene.positions = now.positions;
    scene.normals = now.normals;
    scene.instances = now.instances;
    scene.poses = then.poses + 1;
    compare(draw(renderer, camera), then, thenCamera, now, camera, leastMoving);
  }

  void compare(const Seen& seen, const scene::Scene& then, const scene::Camera& thenCamera,
               const scene::Scene& now, const scene::Camera& camera, double leastMoving) {
    const trace::RayTracer tracer(now, camera.eye);
    size_t compared = 0, moving = 0, wrong = 0;
    for (const trace::Hit& hit : tracer.castPrimary(camera, kWidth, kHeight)) {
      const auto at = [&](uint32_t c) {
        return double{seen.motion.at(hit.pixel.x, hit.pixel.y, c)};
      };
      if (hit.viewDepth == 0 || (hit.pixel.x + 5 * hit.pixel.y) % 16 != 0) continue;
      // At edges, the picture may show another surface than the ray.
      if (std::abs(seen.depth.at(hit.pixel.x, hit.pixel.y) / hit.viewDepth - 1) > 1e-4) continue;
      const glm::dvec3 before = earlier(hit, then, now);
      const glm::dvec3 from = project(thenCamera, before), to = project(camera, hit.position);
      if (from.z <= 0) continue;
      ++compared;
      const bool moved = glm::distance(before, hit.position) > 1e-9;
      moving += moved ? 1 : 0;
      const glm::dvec3 expected(from.x - to.x, from.y - to.y, (from.z - to.z) / to.z);
      const double size = std::max(std::abs(expected.x), std::abs(expected.y));
      const bool right = std::abs(at(0) - expected.x) < 2e-3 * size + 0.01 &&
                         std::abs(at(1) - expected.y) < 2e-3 * size + 0.01 &&
                         std::abs(at(2) - expected.z) < 2e-3 * std::abs(expected.z) + 1e-4 &&
                         (moved ? at(3) == 2 : at(3) >= 1);
      wrong += right ? 0 : 1;
    }
    EXPECT_GT(compared, kWidth * kHeight / 640u);
    EXPECT_GE(moving, leastMoving * static_cast<double>(compared));
    EXPECT_LE(wrong, compared / 100 + 1);
  }

  // Where the surface of a hit was in the other scene: at the same place of the same triangle.
  static glm::dvec3 earlier(const trace::Hit& hit, const scene::Scene& then,
                            const scene::Scene& now) {
    const scene::Primitive& primitive = now.primitives[hit.primitive];
    const auto corner = [&](const scene::Scene& scene, uint32_t k) {
      return glm::dvec3(scene.instances[hit.instance].worldFromObject *
                        glm::dvec4(scene.positions[scene.indices[primitive.firstIndex + k]], 1));
    };
    double least = std::numeric_limits<double>::infinity();
    glm::dvec3 result(0);
    for (uint32_t k = 0; k < primitive.indexCount; k += 3) {
      const glm::dvec3 a = corner(now, k), u = corner(now, k + 1) - a, v = corner(now, k + 2) - a;
      const glm::dvec3 n = glm::cross(u, v), p = hit.position - a;
      const double s = glm::dot(glm::cross(p, v), n) / glm::dot(n, n);
      const double t = glm::dot(glm::cross(u, p), n) / glm::dot(n, n);
      const double outside = std::max({0.0, -s, -t, s + t - 1}) * glm::length(u + v) +
                             std::abs(glm::dot(p, n)) / glm::length(n);
      if (!(outside < least)) continue;
      least = outside;
      const glm::dvec3 b = corner(then, k);
      result = b + s * (corner(then, k + 1) - b) + t * (corner(then, k + 2) - b);
    }
    return result;
  }

  // Pixels, and view depth in metres.
  static glm::dvec3 project(const scene::Camera& camera, const glm::dvec3& p) {
    const glm::dvec3 v = glm::transpose(scene::worldFromView(camera)) * (p - camera.eye);
    const double focal = kHeight / (2 * std::tan(glm::radians(camera.fovyDegrees) / 2));
    return {v.x / -v.z * focal + kWidth / 2.0, -v.y / -v.z * focal + kHeight / 2.0, -v.z};
  }
};
GRISAILLE_ON_EVERY_DEVICE(MotionTest);

scene::Camera cameraAt(double x) {
  return {.eye = glm::dvec3(x, 1.2, 3), .target = glm::dvec3(0.2 * x, 0.3, 0)};
}

scene::Scene shifted(scene::Scene scene, const glm::dvec3& by) {
  for (scene::Instance& instance : scene.instances) {
    instance.worldFromObject[3] += glm::dvec4(by, 0);
  }
  scene::computeBounds(scene);
  return scene;
}

scene::Camera shifted(scene::Camera camera, const glm::dvec3& by) {
  camera.eye += by;
  camera.target += by;
  return camera;
}

TEST_P(MotionTest, OfABoxOnAFloorAndOfTheCamera) {
  const scene::Scene then = tests::boxOnFloor(-0.2), now = tests::boxOnFloor(0.1);
  for (const glm::dvec3 origin : {glm::dvec3(0), glm::dvec3(2e6, -1e6, 3e6)}) {
    const scene::Scene a = shifted(then, origin), b = shifted(now, origin);
    const auto at = [&](double x) { return shifted(cameraAt(x), origin); };
    expectMotion(a, at(0), b, at(0));
    expectMotion(a, at(0), b, at(0.4));
    expectMotion(a, at(0.1), a, at(0), 0);
    scene::Camera nearer = at(0);
    nearer.fovyDegrees = 50;
    nearer.up = glm::dvec3(0.1, 1, 0);
    expectMotion(a, at(0), b, nearer);
  }
}

TEST_P(MotionTest, OfSkinsMorphTargetsAndNodes) {
  size_t found = 0;
  for (const char* name : {"bitmoji_walk.glb", "fox.glb", "simple_morph/SimpleMorph.gltf",
                           "morph_stress/MorphStressTest.gltf", "simple_skin/SimpleSkin.gltf"}) {
    const std::string path = std::string(SHARED_MODELS) + "/" + name;
    if (!std::filesystem::exists(path)) continue;
    ++found;
    SCOPED_TRACE(name);
    scene::Scene then = scene::loadGltf(path);
    const double duration = then.rig->animations[0].duration;
    scene::pose(then, {.animation = 0, .seconds = 0.4 * duration});
    scene::Scene now = then;
    scene::pose(now, {.animation = 0, .seconds = 0.4 * duration + 0.03});
    const scene::Camera camera = scene::defaultCamera(then, double{kWidth} / kHeight);
    scene::Camera moved = camera;
    moved.eye += 0.02 * (moved.target - moved.eye);
    expectMotion(then, camera, now, camera);
    expectMotion(then, moved, now, camera);
  }
  if (found == 0) GTEST_SKIP() << "missing: " << SHARED_MODELS;
}

// A scene that rests, seen by a camera that rests, has a motion of exactly 0.
TEST_P(MotionTest, IsZeroAtRest) {
  const scene::Scene scene = tests::boxOnFloor(0);
  frame::Renderer renderer(device(), scene);
  draw(renderer, cameraAt(0.3));
  const Seen seen = draw(renderer, cameraAt(0.3));
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      for (uint32_t c = 0; c < 3; ++c) ASSERT_EQ(seen.motion.at(x, y, c), 0);
      ASSERT_EQ(seen.motion.at(x, y, 3), seen.depth.at(x, y) > 0 ? 1 : 0);
    }
  }
}

// The first frame knows nothing, and neither does a frame that nobody prepared for.
TEST_P(MotionTest, IsUnknownWithoutAFrameBefore) {
  scene::Scene scene = tests::boxOnFloor(0);
  const auto unknown = [](const Seen& seen) {
    return std::ranges::all_of(seen.motion.pixels, [](float v) { return v == 0; });
  };
  frame::Renderer renderer(device(), scene);
  EXPECT_TRUE(unknown(draw(renderer, cameraAt(0))));
  EXPECT_FALSE(unknown(draw(renderer, cameraAt(0.1))));
  // A frame without motion: what moves since then is not known, but what rests is.
  const std::vector<std::string> outputs = {"depth"};
  const auto drawDepth = [&] {
    renderer.render(
        {.camera = cameraAt(0), .width = kWidth, .height = kHeight, .outputs = outputs});
  };
  drawDepth();
  EXPECT_FALSE(unknown(draw(renderer, cameraAt(0.1))));
  drawDepth();
  tests::moveBox(scene, 0.5);
  EXPECT_TRUE(unknown(draw(renderer, cameraAt(0.1))));
  tests::moveBox(scene, 0.6);
  EXPECT_FALSE(unknown(draw(renderer, cameraAt(0.1))));
}

// A camera that turned round: what lay behind it has no place in the previous frame.
TEST_P(MotionTest, OfWhatLayBehindTheCameraIsUnknown) {
  const scene::Scene scene = tests::boxOnFloor(0);
  frame::Renderer renderer(device(), scene);
  scene::Camera away = cameraAt(0);
  away.target = 2.0 * away.eye - away.target;
  draw(renderer, away);
  const Seen seen = draw(renderer, cameraAt(0));
  for (uint32_t y = kHeight / 2; y < kHeight; ++y) {
    for (uint32_t c = 0; c < 4; ++c) ASSERT_EQ(seen.motion.at(kWidth / 2, y, c), 0);
  }
}

// After a change of size, motion is in pixels of the new size.
TEST_P(MotionTest, IsInPixelsOfTheNewSize) {
  scene::Scene scene = tests::boxOnFloor(-0.2);
  const scene::Scene then = scene;
  frame::Renderer renderer(device(), scene);
  draw(renderer, cameraAt(0), 64, 64);
  tests::moveBox(scene, 0.1);
  compare(draw(renderer, cameraAt(0.2)), then, cameraAt(0), scene, cameraAt(0.2), 0.01);
}

}  // namespace
}  // namespace grisaille
