// SPDX-License-Identifier: MIT
// Ambient visibility, compared with closed forms, and its statistics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "core/trace/ray_tracer.h"
#include "core/trace/sampling.h"
#include "tests/core/trace/scene_builder.h"

namespace grisaille::trace {
namespace {

// The hit straight below a camera at (x, height, z) that looks down.
std::vector<Hit> lookDown(const RayTracer& tracer, double x, double z, double height = 0.01) {
  scene::Camera camera = cameraAt({x, height, z}, {x, 0, z}, {0, 0, -1});
  camera.nearPlane = 1e-4;
  return tracer.castPrimary(camera, 1, 1);
}

TEST(Visibility, APlaneAloneIsFullyOpen) {
  SceneBuilder builder;
  builder.place(builder.floor(glm::vec3(0), 50, builder.material({})));
  const scene::Camera camera = cameraAt({1, 1.7, 2}, {4, 0, -3});
  const RayTracer tracer(builder.scene, camera.eye);
  const auto hits = tracer.castPrimary(camera, 64, 64);
  size_t seen = 0;
  for (const Visibility& value : tracer.ambientOcclusion(hits, 0.5, 64, 1)) {
    EXPECT_EQ(value.mean, 1);
    EXPECT_EQ(value.standardError, 0);
    ++seen;
  }
  EXPECT_EQ(seen, hits.size());
}

// Cosine-weighted directions are points of the unit disc. A wall at distance d blocks the points
// with x >= d / radius: a segment of the disc.
TEST(Visibility, ARightAngledCornerMatchesTheSegmentOfADisc) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 100, material));
  builder.place(
      builder.quad({glm::vec3(0, 0, -100), {0, 0, 100}, {0, 100, 100}, {0, 100, -100}}, material));
  const RayTracer tracer(builder.scene, glm::dvec3(1, 1, 0));
  for (const double radius : {0.25, 0.5, 2.0}) {
    for (const double distance : {0.001, 0.05, 0.1, 0.2, 0.24, 0.4, 0.6}) {
      const double c = std::min(1.0, distance / radius);
      const double blocked = (std::acos(c) - c * std::sqrt(1 - c * c)) / std::numbers::pi;
      const auto hits = lookDown(tracer, distance, 0.3);
      ASSERT_GT(hits[0].viewDepth, 0);
      const Visibility value = tracer.ambientOcclusion(hits, radius, 16384, 3)[0];
      EXPECT_NEAR(value.mean, 1 - blocked, 1e-3) << "radius " << radius << " at " << distance;
    }
  }
}

// Visible share of the disc of directions, integrated on a grid of points: a direction is blocked
// if its ray meets the sphere within `radius`. The sphere of radius `a` rests on the plane and
// touches it `s` metres away.
double sphereVisibility(double a, double s, double radius) {
  constexpr int kSteps = 2000;
  int blocked = 0, counted = 0;
  const glm::dvec3 centre(s, a, 0);
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = 2.0 * (i + 0.5) / kSteps - 1;
      const double z = 2.0 * (j + 0.5) / kSteps - 1;
      if (x * x + z * z >= 1) continue;
      ++counted;
      const double b = glm::dot(glm::dvec3(x, std::sqrt(1 - x * x - z * z), z), centre);
      const double discriminant = b * b - glm::dot(centre, centre) + a * a;
      if (discriminant > 0 && b > 0 && b - std::sqrt(discriminant) <= radius) ++blocked;
    }
  }
  return 1 - static_cast<double>(blocked) / counted;
}

TEST(Visibility, ASphereOnAPlaneMatchesIntegration) {
  constexpr float kRadius = 0.4f;
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 20, material));
  builder.place(builder.sphere({0, kRadius, 0}, kRadius, material));
  const RayTracer tracer(builder.scene, glm::dvec3(1, 1, 0));
  for (const double s : {0.1, 0.2, 0.4, 0.7, 1.5}) {
    const auto hits = lookDown(tracer, 0, s);
    ASSERT_GT(hits[0].viewDepth, 0);
    for (const double radius : {0.2, 0.5, 1.0}) {
      const Visibility value = tracer.ambientOcclusion(hits, radius, 16384, 5)[0];
      EXPECT_NEAR(value.mean, sphereVisibility(kRadius, s, radius), 2e-3)
          << "at " << s << " radius " << radius;
    }
    // Unbounded radius: the form factor of a sphere wholly above the horizon.
    const double form = std::pow(kRadius / std::sqrt(s * s + kRadius * kRadius), 3);
    EXPECT_NEAR(tracer.ambientOcclusion(hits, 1000, 16384, 5)[0].mean, 1 - form, 2e-3) << s;
  }
}

TEST(Visibility, RaysUnderTheFacetAreLeftOut) {
  SceneBuilder builder;
  builder.place(builder.floor(glm::vec3(0), 50, builder.material({})));
  // The normal is 60 degrees from the facet's: a quarter of the rays would go below the open plane.
  for (glm::vec3& normal : builder.scene.normals) {
    normal = glm::vec3(std::sqrt(0.75f), 0.5f, 0);
  }
  const RayTracer tracer(builder.scene, glm::dvec3(0, 1, 0));
  EXPECT_EQ(tracer.ambientOcclusion(lookDown(tracer, 0, 0), 0.5, 256, 1)[0].mean, 1);
  // A normal into the ground leaves no ray to count.
  for (glm::vec3& normal : builder.scene.normals) normal = glm::vec3(0, -1, 0);
  EXPECT_TRUE(std::isnan(tracer.ambientOcclusion(lookDown(tracer, 0, 0), 0.5, 256, 1)[0].mean));
}

TEST(Visibility, TheSameForAnySplitOfThePixels) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 20, material));
  builder.place(builder.sphere({0, 0.4f, 0}, 0.4f, material));
  const scene::Camera camera = cameraAt({1, 1, 1.5}, {0, 0.3, 0});
  const RayTracer tracer(builder.scene, camera.eye);
  const auto whole = tracer.castPrimary(camera, 48, 32);
  const auto values = tracer.ambientOcclusion(whole, 0.5, 32, 9);
  for (size_t i = 0; i < whole.size(); i += 7) {
    const auto hit = tracer.castPrimary(camera, 48, 32, std::span(&whole[i].pixel, 1));
    EXPECT_EQ(hit[0].viewDepth, whole[i].viewDepth);
    EXPECT_EQ(hit[0].normal, whole[i].normal);
    EXPECT_EQ(tracer.ambientOcclusion(hit, 0.5, 32, 9)[0].mean, values[i].mean);
  }
}

TEST(Sampling, EveryPrefixOfPowersOfTwoIsStratified) {
  for (uint32_t seed = 0; seed < 50; ++seed) {
    for (uint32_t bits = 1; bits <= 8; ++bits) {
      // Every elementary interval of this area holds exactly one point.
      for (uint32_t across = 0; across <= bits; ++across) {
        std::vector<int> cells(1u << bits, 0);
        for (uint32_t i = 0; i < (1u << bits); ++i) {
          const glm::vec2 p = sobolPoint(i, seed);
          const auto x = static_cast<uint32_t>(p.x * static_cast<float>(1u << across));
          const auto y = static_cast<uint32_t>(p.y * static_cast<float>(1u << (bits - across)));
          ++cells[(y << across) + x];
        }
        for (const int count : cells) ASSERT_EQ(count, 1) << seed << " " << bits << " " << across;
      }
    }
  }
}

TEST(Sampling, FramesAreOrthonormal) {
  for (uint32_t i = 0; i < 10000; ++i) {
    const glm::vec2 p = sobolPoint(i, 7);
    glm::vec3 n = cosineDirection(p);
    if ((i & 1u) != 0) n.z = -n.z;
    const glm::mat3 frame = frameAbout(n);
    const glm::mat3 product = glm::transpose(frame) * frame;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) EXPECT_NEAR(product[a][b], a == b ? 1 : 0, 2e-6);
    }
    EXPECT_GT(glm::determinant(frame), 0);
  }
}

TEST(Sponza, IsAnAtriumWithPlantsCutOut) {
  const char* named = std::getenv("GRISAILLE_SPONZA");
  const std::string path = named != nullptr ? named : GRISAILLE_SHARED_SPONZA;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "Sponza is missing: " << path;
  const scene::Scene scene = scene::loadGltf(path);
  const scene::Camera camera = cameraAt({-9.0, 1.7, -0.3}, {0, 3.0, -0.4});
  const RayTracer tracer(scene, camera.eye);
  const auto hits = tracer.castPrimary(camera, 160, 90);
  double sum = 0, squares = 0;
  size_t surfaces = 0, strange = 0;
  for (const Hit& hit : hits) {
    if (hit.viewDepth == 0) continue;
    ++surfaces;
    EXPECT_GT(hit.viewDepth, 0.1);
    EXPECT_LT(hit.viewDepth, 40);
    if (glm::dot(hit.facetNormal, glm::dvec3(hit.normal)) <= 0) ++strange;
  }
  EXPECT_GT(surfaces, hits.size() * 9 / 10);
  EXPECT_LT(strange, surfaces / 100);
  for (const Visibility& value : tracer.ambientOcclusion(hits, 0.5, 32, 1)) {
    if (std::isnan(value.mean)) continue;
    sum += value.mean / static_cast<double>(hits.size());
    squares += value.mean * value.mean / static_cast<double>(hits.size());
  }
  EXPECT_GT(sum, 0.6);
  EXPECT_LT(sum, 0.95);
  EXPECT_GT(std::sqrt(squares - sum * sum), 0.08);
}

}  // namespace
}  // namespace grisaille::trace
