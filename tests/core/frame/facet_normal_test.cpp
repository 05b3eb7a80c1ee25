// SPDX-License-Identifier: MIT
// Facet normals of the triangles, compared with ray casts, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/frame/renderer.h"
#include "core/trace/ray_tracer.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

class FacetNormalTest : public tests::BackendTest {
 protected:
  image::Image render(const scene::Scene& scene, const scene::Camera& camera, uint32_t width,
                      uint32_t height) {
    frame::Renderer renderer(device(), scene);
    const std::vector<std::string> outputs = {"facet_normal"};
    renderer.render({.camera = camera, .width = width, .height = height, .outputs = outputs});
    return renderer.read("facet_normal");
  }

  // Hits of the rays that may give a pixel its normal: the ray through its centre and, where the
  // rasteriser snaps vertices coarsely, the rays that move there when a vertex moves by half a
  // step.
  std::vector<std::vector<trace::Hit>> possibleHits(const trace::RayTracer& tracer,
                                                    const scene::Camera& camera, uint32_t width,
                                                    uint32_t height) {
    std::vector<std::vector<trace::Hit>> all = {tracer.castPrimary(camera, width, height)};
    if (!snapping().isCoarse()) return all;
    // In a picture `finer` times as large, the middle four pixels lie half a step from the centre.
    const uint32_t finer = 1u << snapping().bits;
    for (const glm::uvec2 corner : {glm::uvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
      std::vector<glm::uvec2> pixels;
      for (uint32_t i = 0; i < width * height; ++i) {
        pixels.push_back(glm::uvec2(i % width, i / width) * finer + finer / 2 - 1u + corner);
      }
      all.push_back(tracer.castPrimary(camera, width * finer, height * finer, pixels));
    }
    return all;
  }

  static bool agree(const glm::dvec3& normal, const trace::Hit& hit) {
    if (hit.viewDepth == 0) return normal == glm::dvec3(0);
    const double angle = std::atan2(glm::length(glm::cross(normal, hit.facetNormal)),
                                    glm::dot(normal, hit.facetNormal));
    return angle < 0.01;
  }

  // Share of pixels with a normal within 0.01 rad of the normal that a ray finds.
  double agreement(const scene::Scene& scene, const scene::Camera& camera) {
    constexpr uint32_t kWidth = 640, kHeight = 360;
    const image::Image drawn = render(scene, camera, kWidth, kHeight);
    const trace::RayTracer tracer(scene, camera.eye);
    const auto possible = possibleHits(tracer, camera, kWidth, kHeight);
    size_t agreed = 0;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
      const uint32_t x = i % kWidth, y = i / kWidth;
      const glm::dvec3 normal(drawn.at(x, y, 0), drawn.at(x, y, 1), drawn.at(x, y, 2));
      const bool one =
          std::any_of(possible.begin(), possible.end(),
                      [&](const std::vector<trace::Hit>& hits) { return agree(normal, hits[i]); });
      agreed += one ? 1 : 0;
    }
    return static_cast<double>(agreed) / (kWidth * kHeight);
  }
};
GRISAILLE_ON_EVERY_DEVICE(FacetNormalTest);

TEST_P(FacetNormalTest, AgreesWithRaysInTheBuiltInScene) {
  EXPECT_GT(agreement(scene::makeAtrium(), scene::atriumCamera()), 0.999);
}

TEST_P(FacetNormalTest, AgreesWithRaysInSponza) {
  const char* named = std::getenv("GRISAILLE_SPONZA");
  const std::string path = named != nullptr ? named : SHARED_SPONZA;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "Sponza is missing: " << path;
  const scene::Scene scene = scene::loadGltf(path);
  for (const auto& [eye, target] :
       {std::pair{glm::dvec3(-9.0, 1.7, -0.3), glm::dvec3(0, 3, -0.4)},
        std::pair{glm::dvec3(4.5, 1.2, 0.6), glm::dvec3(8, 1.5, -2.5)}}) {
    scene::Camera camera;
    camera.eye = eye;
    camera.target = target;
    EXPECT_GT(agreement(scene, camera), 0.999) << eye.x;
  }
}

// Independent of vertex normals, side, mirroring and distance from the world's origin.
TEST_P(FacetNormalTest, IsTheTrianglesOwnAndFacesTheCamera) {
  for (const double away : {0.0, 1e6}) {
    for (const double mirror : {1.0, -1.0}) {
      for (const double side : {1.0, -1.0}) {
        scene::Scene scene;
        scene.materials.push_back({.name = "card", .doubleSided = true});
        // A slope that falls along +x, with normals that point elsewhere.
        tests::addQuad(scene, {glm::vec3(-9, 3, 9), {9, -3, 9}, {9, -3, -9}, {-9, 3, -9}},
                       {0, 0, 1});
        glm::dmat4& placed = scene.instances[0].worldFromObject;
        placed[0].x = mirror;
        placed[3] = glm::dvec4(away, -away, 0.5 * away, 1);
        scene::computeBounds(scene);
        const glm::dvec3 centre(placed[3]);
        const scene::Camera camera = {.eye = centre + glm::dvec3(0.5, 4 * side, 0.2),
                                      .target = centre};
        const image::Image image = render(scene, camera, 17, 17);
        const glm::dvec3 expected = side * glm::normalize(glm::dvec3(mirror / 3, 1, 0));
        for (uint32_t pixel = 0; pixel < 17; ++pixel) {
          for (uint32_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(image.at(pixel, 8, c), expected[static_cast<int>(c)], 1e-3)
                << away << " " << mirror << " " << side << " pixel " << pixel;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace grisaille
