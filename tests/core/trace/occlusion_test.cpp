// SPDX-License-Identifier: MIT
// Ambient visibility over many pixels, compared with closed forms; the difference must match the
// stated error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/trace/ray_tracer.h"
#include "core/trace/sampling.h"
#include "tests/core/trace/scene_builder.h"

namespace grisaille::trace {
namespace {

constexpr uint32_t kSide = 48;  // pixels
constexpr double kFar = 5000;   // metres: practically infinite

// Hits on a square metre of the floor around (x, 0), seen from straight above at 0.5 m. The points
// form a regular grid.
std::vector<Hit> squareMetre(const RayTracer& tracer, double x) {
  scene::Camera camera = cameraAt({x, 0.5, 0}, {x, 0, 0}, {0, 0, -1});
  camera.fovyDegrees = 90;
  camera.nearPlane = 0.499;
  return tracer.castPrimary(camera, kSide, kSide);
}

// Expects the traced picture to differ from the closed form by about as much as its stated error.
void expectHonest(const RayTracer& tracer, std::span<const Hit> hits, double radius,
                  const std::function<double(const glm::dvec3&)>& visibility) {
  for (const uint32_t samples : {64u, 200u, 1024u}) {
    SCOPED_TRACE(samples);
    const auto values = tracer.ambientOcclusion(hits, radius, samples, 3);
    const double stated = rmsError(hits, values);
    ASSERT_GT(stated, 0);
    double squares = 0, sum = 0;
    size_t far = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      const double off = values[i].mean - visibility(hits[i].position);
      squares += off * off;
      sum += off;
      const double error = std::max<double>(values[i].standardError, stated);
      far += std::abs(off) > 4 * error ? 1 : 0;
    }
    const auto count = static_cast<double>(hits.size());
    EXPECT_NEAR(std::sqrt(squares / count) / stated, 1, 0.1);
    EXPECT_LT(std::abs(sum / count), 4 * stated / std::sqrt(count) + 2e-4);
    EXPECT_LT(static_cast<double>(far) / count, 0.01);
  }
}

TEST(Occlusion, AnOpenPlaneIsOneWithoutAnError) {
  SceneBuilder builder;
  builder.place(builder.floor(glm::vec3(0), 50, builder.material({})));
  const RayTracer tracer(builder.scene, glm::dvec3(0));
  const auto hits = squareMetre(tracer, 0);
  const auto values = tracer.ambientOcclusion(hits, 0.5, 64, 1);
  for (const Visibility& value : values) {
    EXPECT_EQ(value.mean, 1);
    EXPECT_EQ(value.standardError, 0);
  }
  EXPECT_EQ(rmsError(hits, values), 0);
}

// Cosine-weighted directions are uniform over the unit disc under the hemisphere (Malley). A ray of
// length R above (x, y) of the disc travels x R along the x axis. A wall at distance d blocks the
// rays with x >= d / R. On the disc, of area pi, that segment has area acos c - c sqrt(1 - c^2)
// with c = d / R. The wall is higher than R.
TEST(Occlusion, ARightAngledCornerIsHonest) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 100, material));
  builder.place(
      builder.quad({glm::vec3(0, 0, -100), {0, 0, 100}, {0, 100, 100}, {0, 100, -100}}, material));
  const RayTracer tracer(builder.scene, glm::dvec3(0.5, 0, 0));
  for (const double radius : {0.5, 3.0}) {
    expectHonest(tracer, squareMetre(tracer, 0.5), radius, [&](const glm::dvec3& p) {
      const double c = std::min(1.0, p.x / radius);
      return 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / std::numbers::pi;
    });
  }
}

// The form factor of a sphere of radius a, seen from a plane element with the whole sphere above
// its horizon: sin^2(half the sphere's angle) times the cosine of its centre's direction. At
// distance D and height h this is (a / D)^2 (h / D) (Howell, "A Catalog of Radiation Heat Transfer
// Configuration Factors", B-43).
TEST(Occlusion, ASphereOnAPlaneIsHonest) {
  constexpr float kRadius = 0.4f;
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 50, material));
  builder.place(builder.sphere({0, kRadius, 0}, kRadius, material));
  const RayTracer tracer(builder.scene, glm::dvec3(0));
  expectHonest(tracer, squareMetre(tracer, 1.0), 100, [&](const glm::dvec3& p) {
    const double distance = std::hypot(p.x, p.z, double{kRadius});
    return 1 - std::pow(kRadius / distance, 3);
  });
}

// Between parallel walls of height h at distance w, a point sees the sky up to the angles a and b
// from its normal, towards the edges of the walls. The cosine-weighted share is (sin a + sin b) /
// 2: crossed less uncrossed strings of a narrow strip. Over the whole floor, Hottel's strings give
// (2 sqrt(h^2 + w^2) - 2 h) / (2 w).
TEST(Occlusion, ASlotMatchesCrossedStrings) {
  constexpr float kHeight = 0.7f;
  constexpr auto kLong = static_cast<float>(kFar);
  SceneBuilder builder;
  const uint32_t material = builder.material({.name = "wall", .doubleSided = true});
  builder.place(builder.floor(glm::vec3(0), 50, material));
  for (const float x : {-0.5f, 0.5f}) {
    builder.place(builder.quad(
        {glm::vec3(x, 0, -kLong), {x, 0, kLong}, {x, kHeight, kLong}, {x, kHeight, -kLong}},
        material));
  }
  const RayTracer tracer(builder.scene, glm::dvec3(0));
  const auto hits = squareMetre(tracer, 0);
  expectHonest(tracer, hits, kFar, [&](const glm::dvec3& p) {
    const double left = 0.5 + p.x, right = 0.5 - p.x;
    return (left / std::hypot(left, kHeight) + right / std::hypot(right, kHeight)) / 2;
  });
  double mean = 0;
  const auto values = tracer.ambientOcclusion(hits, kFar, 1024, 8);
  for (const Visibility& value : values) mean += value.mean / static_cast<double>(hits.size());
  const double strings = std::hypot(double{kHeight}, 1.0) - double{kHeight};
  EXPECT_NEAR(mean, strings, 4 * rmsError(hits, values) / kSide + 2e-4);
}

// At 64 samples the error is half that of independent rays; the advantage grows with more samples.
TEST(Occlusion, PointsConvergeFasterThanIndependentRays) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 100, material));
  builder.place(
      builder.quad({glm::vec3(0, 0, -100), {0, 0, 100}, {0, 100, 100}, {0, 100, -100}}, material));
  const RayTracer tracer(builder.scene, glm::dvec3(0.5, 0, 0));
  const auto hits = squareMetre(tracer, 0.5);
  double last = 0;
  for (const uint32_t samples : {64u, 512u, 4096u}) {
    const auto values = tracer.ambientOcclusion(hits, 3, samples, 4);
    double binomial = 0;
    for (const Visibility& value : values)
      binomial += double{value.mean} * (1 - value.mean) / samples;
    const double gain =
        std::sqrt(binomial / static_cast<double>(hits.size())) / rmsError(hits, values);
    EXPECT_GT(gain, std::max(1.3, 1.2 * last)) << samples;
    last = gain;
  }
}

TEST(Occlusion, InPassesItIsTheSameToTheBit) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 20, material));
  builder.place(builder.sphere({0, 0.4f, 0}, 0.4f, material));
  const scene::Camera camera = cameraAt({1, 1, 1.5}, {0, 0.3, 0});
  const RayTracer tracer(builder.scene, camera.eye);
  const auto hits = tracer.castPrimary(camera, 32, 24);
  std::vector<OcclusionCounts> once(hits.size()), passes(hits.size());
  tracer.addOcclusion(hits, 0.5, 9, 0, 203, once);
  for (const auto& [from, to] : {std::pair(0u, 5u), {5u, 64u}, {64u, 64u}, {64u, 203u}}) {
    tracer.addOcclusion(hits, 0.5, 9, from, to, passes);
  }
  EXPECT_EQ(once, passes);
  std::vector<OcclusionCounts> other(hits.size());
  tracer.addOcclusion(hits, 0.5, 10, 0, 203, other);
  EXPECT_NE(once, other);
}

TEST(Occlusion, TheErrorByHand) {
  const std::vector<Hit> hits = {{.viewDepth = 1}, {.viewDepth = 1}, {.viewDepth = 1}, {}};
  std::vector<OcclusionCounts> counts(4);
  // Half of the sequences are fully open, half fully blocked: values 0 and 1 with a standard
  // deviation of sqrt(8 / 7) / 2, divided by sqrt(8).
  for (size_t k = 0; k < kScrambles; ++k) {
    counts[0].counted[k] = 10;
    counts[0].open[k] = k % 2 == 0 ? 10 : 0;
  }
  counts[2].counted[3] = 4;
  counts[2].open[3] = 3;
  const auto values = visibilityOf(hits, counts);
  EXPECT_FLOAT_EQ(values[0].mean, 0.5f);
  EXPECT_FLOAT_EQ(values[0].standardError, static_cast<float>(0.5 / std::sqrt(7.0)));
  EXPECT_TRUE(std::isnan(values[1].mean));
  EXPECT_FLOAT_EQ(values[2].mean, 0.75f);
  EXPECT_TRUE(std::isnan(values[2].standardError));
  EXPECT_EQ(values[3].mean, 1);
  EXPECT_EQ(values[3].standardError, 0);
  EXPECT_FLOAT_EQ(static_cast<float>(rmsError(hits, values)), values[0].standardError);
}

}  // namespace
}  // namespace grisaille::trace
