// SPDX-License-Identifier: MIT
// The screen-space ceiling: only surfaces that the picture shows can block rays.
#include "core/trace/depth_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trace/sampling.h"
#include "tests/core/trace/scene_builder.h"

namespace grisaille::trace {
namespace {

constexpr uint32_t kFieldWidth = 64;
constexpr uint32_t kFieldHeight = 48;

struct View {
  View(const scene::Scene& scene, const scene::Camera& theCamera)
      : camera(theCamera),
        tracer(scene, camera.eye),
        hits(tracer.castPrimary(camera, kFieldWidth, kFieldHeight)),
        field(hits, camera, kFieldWidth, kFieldHeight) {}

  std::vector<Visibility> ceiling(double radius, double thickness, uint32_t samples) const {
    std::vector<OcclusionCounts> counts(hits.size());
    field.addOcclusion(hits, radius, thickness, 1, 0, samples, counts);
    return visibilityOf(hits, counts);
  }
  std::vector<Visibility> truth(double radius, uint32_t samples) const {
    return tracer.ambientOcclusion(hits, radius, samples, 1);
  }

  scene::Camera camera;
  RayTracer tracer;
  std::vector<Hit> hits;
  DepthField field;
};

double meanOf(std::span<const Visibility> values) {
  double sum = 0;
  for (const Visibility& value : values) sum += value.mean;
  return sum / static_cast<double>(values.size());
}

TEST(DepthField, APlaneIsOpenAtAnySlant) {
  SceneBuilder builder;
  builder.place(builder.floor(glm::vec3(0), 300, builder.material({})));
  for (const double height : {0.05, 0.5, 5.0}) {
    const View view(builder.scene, cameraAt({0, height, 0}, {3, 0, 1}));
    for (const Visibility& value : view.ceiling(2, 0.5, 64)) EXPECT_EQ(value.mean, 1) << height;
  }
}

// The picture shows every blocker, and the picture's facets are the surfaces' planes. Except at
// pixels with the edge, the ceiling equals the truth for each ray.
TEST(DepthField, ACornerInFullViewIsTheTruth) {
  SceneBuilder builder;
  const uint32_t material = builder.material({.name = "both sides", .doubleSided = true});
  builder.place(builder.floor(glm::vec3(0), 100, material));
  builder.place(
      builder.quad({glm::vec3(0, 0, -100), {0, 0, 100}, {0, 100, 100}, {0, 100, -100}}, material));
  const View view(builder.scene, cameraAt({3, 2.5, 0.2}, {0, 0, 0}));
  const auto ceiling = view.ceiling(0.5, 0.25, 64);
  const auto truth = view.truth(0.5, 64);
  size_t equal = 0, inner = 0;
  for (uint32_t y = 0; y < kFieldHeight; ++y) {
    for (uint32_t x = kFieldWidth / 4; x < kFieldWidth * 3 / 4; ++x) {
      const size_t i = y * kFieldWidth + x;
      equal += ceiling[i].mean == truth[i].mean ? 1 : 0;
      EXPECT_NEAR(ceiling[i].mean, truth[i].mean, 0.2);
      ++inner;
    }
  }
  EXPECT_GT(static_cast<double>(equal), 0.8 * static_cast<double>(inner));
  EXPECT_LT(meanOf(truth), 0.98);
}

// A card in front of a wall, farther away than the radius, blocks nothing. A picture cannot
// distinguish it from a block as deep as the gap.
TEST(DepthField, ThicknessIsWhatAPictureCannotTell) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  const auto wall = [&](float z, float half) {
    return builder.quad(
        {glm::vec3(-half, -half, z), {half, -half, z}, {half, half, z}, {-half, half, z}},
        material);
  };
  builder.place(wall(0, 20));
  builder.place(wall(1, 0.4f));
  const View view(builder.scene, cameraAt({0, 0, 4}, {0, 0, 0}));
  EXPECT_EQ(meanOf(view.truth(0.9, 64)), 1);
  EXPECT_EQ(meanOf(view.ceiling(0.9, 0.09, 64)), 1);
  const double thick = meanOf(view.ceiling(0.9, 0.99, 64));
  EXPECT_LT(thick, 0.99);
  EXPECT_LT(meanOf(view.ceiling(0.9, 1.5, 64)), thick);
}

// The picture does not show the wall just beyond its edge: the truth is darker.
TEST(DepthField, OffThePictureIsOpen) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 100, material));
  scene::Camera camera = cameraAt({0, 1, 0}, {0, 0, 0}, {0, 0, -1});
  const double half = std::tan(glm::radians(30.0)) * kFieldWidth / kFieldHeight;
  const auto x = static_cast<float>(half + 0.01);
  builder.place(builder.quad({glm::vec3(x, 0, 100), {x, 0, -100}, {x, 100, -100}, {x, 100, 100}},
                             builder.material({.name = "wall", .doubleSided = true})));
  const View view(builder.scene, camera);
  EXPECT_LT(meanOf(view.truth(0.5, 64)), 0.95);
  EXPECT_EQ(meanOf(view.ceiling(0.5, 10, 64)), 1);
}

// Samples closely spaced points of a ray and tests each against the matter, with the camera's own
// numbers.
bool isOpenByPoints(const View& view, const Hit& from, const glm::dvec3& direction, double radius,
                    double thickness) {
  constexpr int kPoints = 4000;
  const glm::dvec3 forward = glm::normalize(view.camera.target - view.camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, view.camera.up));
  const glm::dvec3 up = glm::cross(right, forward);
  const double tangent = std::tan(glm::radians(view.camera.fovyDegrees) / 2);
  for (int i = 1; i <= kPoints; ++i) {
    const glm::dvec3 point = from.position + radius * i / kPoints * direction - view.camera.eye;
    const double depth = glm::dot(point, forward);
    if (depth < view.camera.nearPlane) return true;
    const double x =
        (glm::dot(point, right) / depth / tangent + double{kFieldWidth} / kFieldHeight) / 2;
    const double y = (1 - glm::dot(point, up) / depth / tangent) / 2;
    const double column = std::floor(x * kFieldHeight), row = std::floor(y * kFieldHeight);
    if (column < 0 || row < 0 || column >= kFieldWidth || row >= kFieldHeight) return true;
    const Hit& shown = view.hits[static_cast<size_t>(row * kFieldWidth + column)];
    if (shown.viewDepth == 0) continue;
    const glm::dvec3 place = shown.position - view.camera.eye;
    const double surface =
        depth * glm::dot(shown.facetNormal, place) / glm::dot(shown.facetNormal, point);
    if (surface > 0 && depth > surface * (1 + 1e-9) && depth < surface + thickness) return false;
  }
  return true;
}

TEST(DepthField, TheWalkIsExact) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 20, material));
  builder.place(builder.sphere({0, 0.4f, 0}, 0.4f, material));
  builder.place(builder.sphere({0.5f, 0.2f, 0.6f}, 0.2f, material));
  const View view(builder.scene, cameraAt({0.9, 0.8, 1.5}, {0.1, 0.3, 0}));
  constexpr uint32_t kRays = 16;
  size_t rays = 0, differ = 0, blocked = 0;
  for (size_t i = 0; i < view.hits.size(); i += 5) {
    const Hit& hit = view.hits[i];
    if (hit.viewDepth == 0) continue;
    for (uint32_t k = 0; k < kRays; ++k) {
      std::vector<OcclusionCounts> counts(1);
      view.field.addOcclusion(std::span(&hit, 1), 0.7, 0.15, 1, k, k + 1, counts);
      const uint32_t sequence = k % kScrambles;
      if (counts[0].counted[sequence] == 0) continue;
      const uint32_t pixel = hashBits(hit.pixel.x + hashBits(hit.pixel.y + hashBits(1)));
      const glm::vec3 direction =
          frameAbout(hit.normal) *
          cosineDirection(sobolPoint(k / kScrambles, hashBits(pixel + sequence)));
      const bool open = isOpenByPoints(view, hit, glm::dvec3(direction), 0.7, 0.15);
      differ += open != (counts[0].open[sequence] > 0) ? 1 : 0;
      blocked += open ? 0 : 1;
      ++rays;
    }
  }
  // The points miss matter that is thinner than their spacing.
  EXPECT_GT(blocked, rays / 20);
  EXPECT_LE(differ, rays / 200) << rays << " rays, " << blocked << " blocked";
}

}  // namespace
}  // namespace grisaille::trace
