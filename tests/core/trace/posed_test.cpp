// SPDX-License-Identifier: MIT
// A tracer that follows the poses of a scene casts the same rays as one made for the pose.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/scene/rig.h"
#include "core/trace/ray_tracer.h"
#include "tests/support/animated_gltf.h"

namespace grisaille::trace {
namespace {

constexpr uint32_t kWidth = 96, kHeight = 54;

std::string animatedFile() {
  const auto path = std::filesystem::temp_directory_path() /
                    ("grisaille_posed_" + std::to_string(getpid()) + ".glb");
  std::ofstream(path, std::ios::binary) << tests::animatedGlb();
  return path;
}

// Rays from outside to points all over the scene's bounds.
std::vector<grisaille_ray> raysInto(const scene::Scene& scene) {
  std::vector<grisaille_ray> rays;
  const scene::Bounds& b = scene.bounds;
  const double size = glm::length(b.max - b.min);
  for (int i = 0; i < 400; ++i) {
    const double t = i / 400.0;
    const glm::dvec3 to =
        b.min + (b.max - b.min) * glm::dvec3(t, std::fmod(7 * t, 1.0), std::fmod(29 * t, 1.0));
    const glm::dvec3 from = to + 2.0 * size * glm::dvec3(std::cos(40 * t), 0.5, std::sin(40 * t));
    const glm::dvec3 direction = glm::normalize(to - from);
    rays.push_back({.origin = {from.x, from.y, from.z},
                    .direction = {float(direction.x), float(direction.y), float(direction.z)},
                    .reach = static_cast<float>(4 * size)});
  }
  return rays;
}

// Returns the number of pixels that see a surface.
size_t expectSame(const scene::Scene& scene, const RayTracer& follower, const glm::dvec3& origin,
                  const scene::Camera& camera) {
  const RayTracer fresh(scene, origin);
  const auto expected = fresh.castPrimary(camera, kWidth, kHeight);
  const auto hits = follower.castPrimary(camera, kWidth, kHeight);
  size_t seen = 0, others = 0;
  for (size_t i = 0; i < hits.size(); ++i) {
    const double depth = expected[i].viewDepth;
    if (std::abs(hits[i].viewDepth - depth) > 1e-6 * depth) ++others;
    if (depth > 0) ++seen;
  }
  EXPECT_EQ(others, 0u);
  const std::vector<grisaille_ray> rays = raysInto(scene);
  std::vector<grisaille_hit> met(rays.size()), should(rays.size());
  follower.castRays(rays, met);
  fresh.castRays(rays, should);
  size_t different = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (met[i].kind != should[i].kind || met[i].distance != should[i].distance) ++different;
  }
  EXPECT_EQ(different, 0u);
  return seen;
}

void expectFollows(const std::string& path) {
  SCOPED_TRACE(path);
  scene::Scene scene = scene::loadGltf(path);
  if (!scene.rig) return;
  const scene::Camera camera = scene::defaultCamera(scene, double{kWidth} / kHeight);
  RayTracer tracer(scene, camera.eye);
  size_t seen = 0;
  for (size_t a = 0; a < scene.rig->animations.size(); ++a) {
    for (const double share : {0.13, 0.5, 0.97}) {
      SCOPED_TRACE(testing::Message() << "animation " << a << " at " << share);
      scene::pose(scene, {.animation = a, .seconds = share * scene.rig->animations[a].duration});
      tracer.follow();
      seen += expectSame(scene, tracer, camera.eye, camera);
    }
  }
  if (!scene.rig->animations.empty()) {
    EXPECT_GT(seen, 100u);
  }
  scene::pose(scene, {});
  tracer.follow();
  expectSame(scene, tracer, camera.eye, camera);
}

TEST(PosedTracer, FollowsEveryKindOfChannel) {
  const std::string path = animatedFile();
  expectFollows(path);
  std::filesystem::remove(path);
}

TEST(PosedTracer, FollowsSharedModels) {
  size_t found = 0;
  for (const char* name :
       {"fox.glb", "bitmoji_walk.glb", "simple_skin/SimpleSkin.gltf",
        "skinned_cylinder/03_skinned_cylinder.gltf", "simple_morph/SimpleMorph.gltf",
        "morph_stress/MorphStressTest.gltf", "animation_pointer/24_animation_pointer.gltf"}) {
    const std::string path = std::string(SHARED_MODELS) + "/" + name;
    if (!std::filesystem::exists(path)) continue;
    ++found;
    expectFollows(path);
  }
  if (found == 0) GTEST_SKIP() << "missing: " << SHARED_MODELS;
}

TEST(PosedTracer, KeepsItsPoseUntilItFollows) {
  const std::string path = animatedFile();
  scene::Scene scene = scene::loadGltf(path);
  std::filesystem::remove(path);
  const std::vector<bool> moving = scene::movingInstances(scene);
  EXPECT_EQ(std::ranges::count(moving, true), 3);
  EXPECT_EQ(std::ranges::count(moving, false), 1);  // the floor
  RayTracer tracer(scene, {});
  // Down onto the place that the box reaches after 1 s.
  const std::vector<grisaille_ray> down = {
      {.origin = {-1.5, 5, 1.5}, .direction = {0, -1, 0}, .reach = 10}};
  std::vector<grisaille_hit> hit(1);
  tracer.castRays(down, hit);
  const float before = hit[0].distance;
  scene::pose(scene, {.animation = 0, .seconds = 1});
  tracer.follow();
  tracer.castRays(down, hit);
  EXPECT_LT(hit[0].distance, before - 0.5f);
}

}  // namespace
}  // namespace grisaille::trace
