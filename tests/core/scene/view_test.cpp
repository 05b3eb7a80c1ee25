// SPDX-License-Identifier: MIT
// Cameras of every kind map pixels to positions and back, in every way that the code computes it.
#include <gtest/gtest.h>

#include "core/scene/view.h"

namespace grisaille::scene {
namespace {

constexpr glm::uvec2 kSize(64, 48);

std::vector<Camera> cameras() {
  Camera camera{.eye = {1, 2, 3}, .target = {-4, 0, 2}, .up = {0.2, 1, 0}, .fovyDegrees = 50};
  camera.nearPlane = 0.5;
  camera.farPlane = 20;
  std::vector<Camera> all;
  for (const double height : {0.0, 7.0}) {
    for (const glm::dvec2 shift : {glm::dvec2(0), {0.7, -0.4}, {0.3 / 64, 0.2 / 48}}) {
      camera.orthographicHeight = height;
      camera.shift = shift;
      all.push_back(camera);
    }
  }
  return all;
}

TEST(View, PositionsAndPixelsAreInverse) {
  for (const Camera& camera : cameras()) {
    const View view = viewOf(camera, kSize);
    const glm::dmat4 clip = clipFromView(view);
    for (const glm::dvec2 pixel : {glm::dvec2(0.5, 0.5), {63.5, 0.5}, {10.25, 40}, {32, 24}}) {
      for (const double depth : {0.5, 3.0, 20.0}) {
        const glm::dvec3 position = viewPosition(view, pixel, depth);
        EXPECT_NEAR(-position.z, depth, 1e-12);
        EXPECT_LT(glm::length(pixelOf(view, position) - pixel), 1e-9);
        const glm::dvec4 p = clip * glm::dvec4(position, 1);
        EXPECT_NEAR((p.x / p.w + 1) / 2 * kSize.x, pixel.x, 1e-9);
        EXPECT_NEAR((1 - p.y / p.w) / 2 * kSize.y, pixel.y, 1e-9);
        EXPECT_NEAR(p.z / p.w, clipDepthOf(view, depth), 1e-12);
        EXPECT_NEAR(viewDepthOf(view, p.z / p.w), depth, 1e-9);
        const ViewRay ray = rayAt(view, pixel);
        const glm::dvec3 world = worldPosition(view, pixel, depth);
        EXPECT_LT(glm::length(ray.origin + depth * ray.direction - world), 1e-12);
        // A pixel further down is one pixel's size away.
        const glm::dvec3 below = viewPosition(view, pixel + glm::dvec2(0, 1), depth);
        EXPECT_NEAR(glm::length(below - position), pixelSize(view, depth), 1e-12);
      }
    }
    EXPECT_NEAR(clipDepthOf(view, view.nearPlane), 1, 1e-12);
  }
}

TEST(View, TheAxisPassesThroughTheShiftedCentre) {
  for (const Camera& camera : cameras()) {
    const View view = viewOf(camera, kSize);
    const glm::dvec2 axis = pixelOf(view, {0, 0, -2});
    EXPECT_NEAR(axis.x, kSize.x * (0.5 - camera.shift.x), 1e-9);
    EXPECT_NEAR(axis.y, kSize.y * (0.5 + camera.shift.y), 1e-9);
  }
}

TEST(View, AGuardBandKeepsThePicture) {
  for (const Camera& camera : cameras()) {
    const View view = viewOf(camera, kSize), wide = widened(view, 8);
    EXPECT_EQ(wide.size, kSize + 16u);
    const glm::dvec2 pixel(11.5, 3.25);
    EXPECT_LT(glm::length(viewPosition(view, pixel, 3) - viewPosition(wide, pixel + 8.0, 3)),
              1e-12);
  }
}

// The four quarters of a picture, drawn as tiles, show what the whole shows.
TEST(View, TilesMakeUpThePicture) {
  for (Camera camera : cameras()) {
    camera.shift = glm::dvec2(0);
    const View whole = viewOf(camera, kSize);
    Camera tile = camera;
    tile.fovyDegrees =
        glm::degrees(2 * std::atan(std::tan(glm::radians(camera.fovyDegrees) / 2) / 2));
    tile.orthographicHeight /= 2;
    for (const glm::dvec2 place : {glm::dvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
      tile.shift = {place.x - 0.5, 0.5 - place.y};
      const View part = viewOf(tile, kSize / 2u);
      const glm::dvec2 pixel(5.5, 17.5);
      const glm::dvec2 inWhole = pixel + place * glm::dvec2(kSize / 2u);
      EXPECT_LT(glm::length(viewPosition(part, pixel, 3) - viewPosition(whole, inWhole, 3)), 1e-12);
    }
  }
}

}  // namespace
}  // namespace grisaille::scene
