// SPDX-License-Identifier: MIT
// Scenes with skins, morph targets, instances and vertex colours: the drawn attachments agree with
// rays, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/frame/renderer.h"
#include "core/scene/rig.h"
#include "core/trace/ray_tracer.h"
#include "tests/support/devices.h"
#include "tests/support/scene_files.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

class ModelsTest : public tests::BackendTest {
 protected:
  static constexpr uint32_t kWidth = 160, kHeight = 90;

  static image::Image render(frame::Renderer& renderer, const scene::Camera& camera,
                             const std::string& output) {
    const std::vector<std::string> outputs = {output};
    renderer.render({.camera = camera, .width = kWidth, .height = kHeight, .outputs = outputs});
    return renderer.read(output);
  }

  image::Image render(const scene::Scene& scene, const scene::Camera& camera,
                      const std::string& output) {
    frame::Renderer renderer(device(), scene);
    return render(renderer, camera, output);
  }

  static scene::Camera cameraOf(const scene::Scene& scene) {
    return scene::defaultCamera(scene, double{kWidth} / kHeight);
  }

  void expectDepthOfRays(const scene::Scene& scene) {
    frame::Renderer renderer(device(), scene);
    expectDepthOfRays(scene, renderer, cameraOf(scene));
  }

  void expectDepthOfRays(const scene::Scene& scene, frame::Renderer& renderer,
                         const scene::Camera& camera) {
    const image::Image drawn = render(renderer, camera, "depth");
    const trace::RayTracer tracer(scene, camera.eye);
    const std::vector<trace::Hit> hits = tracer.castPrimary(camera, kWidth, kHeight);
    std::vector<double> errors;
    size_t covered = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      const double depth = drawn.pixels[i], traced = hits[i].viewDepth;
      if ((depth > 0) != (traced > 0)) ++covered;
      if (depth > 0 && traced > 0) errors.push_back(std::abs(depth - traced) / traced);
    }
    ASSERT_GT(errors.size(), 20u);
    std::ranges::sort(errors);
    EXPECT_LT(errors[errors.size() / 2],
              snapping().movesDepth() ? 0.032 * snapping().halfStep() : 1e-5);
    if (snapping().isCoarse()) return;
    EXPECT_LT(covered, errors.size() / 50 + 3);
  }

  static scene::Scene colouredWall() {
    scene::Scene scene = tests::wallScene(4, 4);
    scene.materials[0].baseColor = {0.5f, 1, 1, 1};
    scene.primitives[0].coloured = true;
    // Red grows to the right, alpha to the top.
    for (const glm::vec3& p : scene.positions) {
      scene.colours.emplace_back(p.x > 0 ? 1 : 0, 0.25f, 1, p.y > 0 ? 1 : 0);
    }
    return scene;
  }
};
GRISAILLE_ON_EVERY_DEVICE(ModelsTest);

TEST_P(ModelsTest, DepthOfSharedScenesIsThatOfRays) {
  size_t found = 0;
  for (const std::string& path : tests::sceneFilesBelow({SHARED_MODELS, SHARED_SCENES})) {
    // It has no mesh.
    if (path.ends_with("/no_inverse_bind.glb")) continue;
    ++found;
    SCOPED_TRACE(path);
    scene::Scene scene = scene::loadGltf(path);
    expectDepthOfRays(scene);
    if (!scene.rig || scene.rig->animations.empty()) continue;
    scene::pose(scene, {.animation = 0, .seconds = 0.4 * scene.rig->animations[0].duration});
    expectDepthOfRays(scene);
  }
  if (found == 0) GTEST_SKIP() << "no scenes in " << SHARED_MODELS;
}

// One renderer follows scene::pose(): its picture is that of a renderer made after the pose.
// Normals are drawn in the first and the last frame alone, so that poses pass between their
// uploads.
TEST_P(ModelsTest, RendererFollowsThePose) {
  size_t found = 0;
  for (const char* name : {"fox.glb", "bitmoji_walk.glb", "simple_skin/SimpleSkin.gltf",
                           "simple_morph/SimpleMorph.gltf", "morph_stress/MorphStressTest.gltf",
                           "animation_pointer/24_animation_pointer.gltf"}) {
    const std::string path = std::string(SHARED_MODELS) + "/" + name;
    if (!std::filesystem::exists(path)) continue;
    ++found;
    SCOPED_TRACE(name);
    scene::Scene scene = scene::loadGltf(path);
    const scene::Camera camera = cameraOf(scene);
    frame::Renderer renderer(device(), scene);
    render(renderer, camera, "normal");
    for (size_t animation = 0; animation < scene.rig->animations.size(); ++animation) {
      for (const double share : {0.3, 0.5, 0.8}) {
        SCOPED_TRACE(share);
        const double seconds = share * scene.rig->animations[animation].duration;
        scene::pose(scene, {.animation = animation, .seconds = seconds});
        expectDepthOfRays(scene, renderer, camera);
      }
    }
    EXPECT_EQ(render(renderer, camera, "normal").pixels, render(scene, camera, "normal").pixels);
    EXPECT_EQ(render(renderer, camera, "depth").pixels, render(scene, camera, "depth").pixels);
  }
  if (found == 0) GTEST_SKIP() << "missing: " << SHARED_MODELS;
}

// Texture coordinates that are equal everywhere have gradients of 0, which some filters divide by.
TEST_P(ModelsTest, ABaseColourNeedsNoTexture) {
  scene::Scene scene = tests::wallScene(4, 4);
  scene.materials[0].baseColor = {0.5f, 0.25f, 1, 1};
  std::ranges::fill(scene.texCoords, glm::vec2(0));
  const image::Image drawn = render(scene, {.eye = {0, 0, 6}, .target = {0, 0, 0}}, "base_colour");
  for (uint32_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(drawn.at(kWidth / 2, kHeight / 2, c), scene.materials[0].baseColor[c], 0.01);
  }
}

TEST_P(ModelsTest, VertexColoursMultiplyTheBaseColour) {
  const scene::Scene scene = colouredWall();
  const scene::Camera camera = {.eye = {0, 0, 6}, .target = {0, 0, 0}};
  const image::Image drawn = render(scene, camera, "base_colour");
  const trace::RayTracer tracer(scene, camera.eye);
  size_t compared = 0;
  for (const trace::Hit& hit : tracer.castPrimary(camera, kWidth, kHeight)) {
    if (hit.viewDepth == 0 || std::abs(hit.position.x) > 1.9) continue;
    ++compared;
    const auto at = [&](uint32_t c) { return drawn.at(hit.pixel.x, hit.pixel.y, c); };
    EXPECT_NEAR(at(0), 0.5 * (hit.position.x + 2) / 4, 0.02);
    EXPECT_NEAR(at(1), 0.25, 0.01);
    EXPECT_NEAR(at(2), 1, 0.01);
  }
  EXPECT_GT(compared, 1000u);
}

// The same holes in every set of attachments, and for rays.
TEST_P(ModelsTest, AlphaOfVertexColoursMakesHoles) {
  scene::Scene scene = colouredWall();
  scene.materials[0].masked = true;
  scene.materials[0].doubleSided = true;
  const scene::Camera camera = {.eye = {0, 0, 6}, .target = {0, 0, 0}};
  const trace::RayTracer tracer(scene, camera.eye);
  // The next surface lies behind a sheet.
  scene::Scene covered = scene;
  covered.materials.push_back({.name = "sheet", .doubleSided = true});
  tests::addQuad(covered, {glm::vec3(-4, -4, 1), {4, -4, 1}, {4, 4, 1}, {-4, 4, 1}}, {0, 0, 1}, 1);
  covered.colours.resize(covered.positions.size(), glm::vec4(1));
  for (const std::string output :
       {"depth", "normal", "base_colour", "facet_normal", "back_depth", "next_depth"}) {
    const image::Image drawn =
        render(output == "next_depth" ? covered : scene, camera, output.c_str());
    size_t surface = 0, holes = 0;
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 60; x < 100; ++x) {
        const auto hit = tracer.castPrimary(camera, kWidth, kHeight, std::vector{glm::uvec2(x, y)});
        // The row of alpha 0.5 is the middle of the wall.
        if (y + 1 >= kHeight / 2 && y <= kHeight / 2) continue;
        double sum = 0;
        for (uint32_t c = 0; c < drawn.channels; ++c) sum += std::abs(drawn.at(x, y, c));
        const bool solid = hit[0].viewDepth > 0;
        EXPECT_EQ(sum > 0, solid) << output << " " << x << " " << y;
        ++(solid ? surface : holes);
      }
    }
    EXPECT_GT(surface, 100u);
    EXPECT_GT(holes, 100u);
  }
}

}  // namespace
}  // namespace grisaille
