// SPDX-License-Identifier: MIT
// Rays answered from a frame: against rays through the scene on every backend, and on drawn-up
// frames whose answers are known.
#include "core/frame/depth_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "core/frame/renderer.h"
#include "core/trace/ray_tracer.h"
#include "tests/support/devices.h"
#include "tests/support/expect_error.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

grisaille_ray rayFrom(const glm::dvec3& origin, const glm::dvec3& towards,
                      float reach = kInfinity) {
  const glm::vec3 unit(glm::normalize(towards));
  return {{origin.x, origin.y, origin.z}, {unit.x, unit.y, unit.z}, reach};
}

grisaille_hit castOne(effect::RayService& rays, const grisaille_ray& ray) {
  grisaille_hit hit = {};
  rays.cast({&ray, 1}, {&hit, 1});
  return hit;
}

class DepthRaysTest : public tests::BackendTest {
 protected:
  static constexpr uint32_t kWidth = 960, kHeight = 540;
  static constexpr size_t kCount = 20000;

  struct Tally {
    size_t none = 0, hits = 0, unknown = 0;
    size_t wrongNone = 0, wrongHits = 0;
  };

  void SetUp() override {
    BackendTest::SetUp();
    if (IsSkipped()) return;
    scene_ = scene::makeAtrium();
    camera_ = scene::atriumCamera();
    frame::Renderer renderer(device(), scene_);
    const std::vector<std::string> outputs = {"depth", "facet_normal"};
    renderer.render(
        {.camera = camera_, .width = kWidth, .height = kHeight, .effects = {}, .outputs = outputs});
    depth_ = renderer.read("depth");
    rays_.emplace(depth_, renderer.read("facet_normal"), camera_);
    tracer_.emplace(scene_, camera_.eye);
  }

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  glm::dvec2 randomPlace() { return glm::dvec2(unit(), unit()) * glm::dvec2(kWidth, kHeight); }
  glm::dvec3 sightOf(const glm::dvec2& place) const {
    return scene::pixelDirection(camera_, kWidth, kHeight, place);
  }
  // From 5 cm to 20 m, or endless.
  float randomReach() {
    const double reach = 0.05 * std::pow(400.0, unit());
    return unit() < 0.2 ? kInfinity : static_cast<float>(reach);
  }
  // From a point that lies at a share of a pixel's depth, in any direction.
  std::vector<grisaille_ray> randomRays(double leastShare, double mostShare) {
    std::normal_distribution<double> normal;
    std::vector<grisaille_ray> rays;
    while (rays.size() < kCount) {
      const glm::dvec2 place = randomPlace();
      const double metres =
          depth_.at(static_cast<uint32_t>(place.x), static_cast<uint32_t>(place.y));
      const double share = leastShare + (mostShare - leastShare) * unit();
      const glm::dvec3 towards(normal(random_), normal(random_), normal(random_));
      if (metres == 0) continue;
      rays.push_back(
          rayFrom(camera_.eye + share * metres * sightOf(place), towards, randomReach()));
    }
    return rays;
  }

  static bool agree(const grisaille_hit& told, const grisaille_hit& traced) {
    if (told.kind != traced.kind) return false;
    return told.kind == GRISAILLE_HIT_NONE ||
           std::abs(told.distance - traced.distance) <= 2e-3f * traced.distance;
  }

  // What else `second` may say, where it is given, counts as right too.
  Tally check(const std::vector<grisaille_ray>& rays,
              const std::vector<grisaille_ray>& second = {}) {
    std::vector<grisaille_hit> told(rays.size()), traced(rays.size()), also(second.size());
    rays_->cast(rays, told);
    tracer_->castRays(rays, traced);
    tracer_->castRays(second, also);
    Tally tally;
    for (size_t i = 0; i < rays.size(); ++i) {
      const bool right = agree(told[i], traced[i]) || (!also.empty() && agree(told[i], also[i]));
      if (told[i].kind == GRISAILLE_HIT_NONE) {
        ++tally.none;
        tally.wrongNone += right ? 0 : 1;
      } else if (told[i].kind == GRISAILLE_HIT_SURFACE) {
        ++tally.hits;
        tally.wrongHits += right ? 0 : 1;
      } else {
        ++tally.unknown;
      }
    }
    std::printf("%s: none %zu (%zu wrong), hits %zu (%zu wrong), unknown %zu\n",
                GetParam().label.c_str(), tally.none, tally.wrongNone, tally.hits, tally.wrongHits,
                tally.unknown);
    return tally;
  }

  scene::Scene scene_;
  scene::Camera camera_;
  image::Image depth_;
  std::optional<frame::DepthRays> rays_;
  std::optional<trace::RayTracer> tracer_;
  std::mt19937 random_{5};
};
GRISAILLE_ON_EVERY_DEVICE(DepthRaysTest);

TEST_P(DepthRaysTest, TheEyeSeesWhatThePixelShows) {
  // Through the pixel's centre, and anywhere in the pixel: there an edge may be half a pixel off.
  std::vector<grisaille_ray> centres, anywhere;
  while (anywhere.size() < kCount) {
    const glm::dvec2 place = randomPlace();
    const float reach = randomReach();
    centres.push_back(rayFrom(camera_.eye, sightOf(glm::floor(place) + 0.5), reach));
    anywhere.push_back(rayFrom(camera_.eye, sightOf(place), reach));
  }
  for (const Tally& tally : {check(centres), check(anywhere, centres)}) {
    EXPECT_EQ(tally.unknown, 0u);
    EXPECT_GT(tally.hits, kCount / 5);
    EXPECT_GT(tally.none, kCount / 5);
    EXPECT_LE(tally.wrongNone + tally.wrongHits, kCount / 200);
  }
  const Tally alone = check(anywhere);
  EXPECT_LE(alone.wrongNone + alone.wrongHits, kCount / 50);
}

TEST_P(DepthRaysTest, RaysThroughTheViewAgreeWithTheScene) {
  const Tally tally = check(randomRays(0.03, 0.98));
  EXPECT_GT(tally.none, kCount / 4);
  EXPECT_GT(tally.hits, kCount / 20);
  EXPECT_LE(tally.wrongNone, tally.none / 1000);
  // Where vertices snap coarsely, depths on slopes are off by more than a short ray's 2e-3.
  EXPECT_LE(tally.wrongHits, tally.hits / (snapping().isCoarse() ? 40 : 200));
}

TEST_P(DepthRaysTest, BehindWallsNothingIsKnown) {
  const Tally tally = check(randomRays(1.01, 2));
  EXPECT_EQ(tally.unknown, kCount);
}

// A frame of a wall 10 m off, with a card of 2 m x 2 m before it, 4 m off, and sky in the upper
// quarter. The eye is a million metres from the world's origin and looks along -z.
class DrawnRays : public ::testing::Test {
 protected:
  static constexpr uint32_t kSide = 200;
  static constexpr float kNear = 0.1f;

  DrawnRays() : rays_(draw(), normals(kSide), camera()) {}

  static scene::Camera camera() {
    scene::Camera camera;
    camera.eye = glm::dvec3(1e6, -1e6, 1e6);
    camera.target = camera.eye - glm::dvec3(0, 0, 1);
    camera.fovyDegrees = 90;
    camera.nearPlane = kNear;
    return camera;
  }
  static image::Image normals(uint32_t side) {
    image::Image image{.width = side, .height = side, .channels = 3, .pixels = {}};
    for (uint32_t i = 0; i < side * side; ++i) image.pixels.insert(image.pixels.end(), {0, 0, 1});
    return image;
  }
  static image::Image draw() {
    image::Image image{.width = kSide, .height = kSide, .channels = 1, .pixels = {}};
    for (uint32_t y = 0; y < kSide; ++y) {
      for (uint32_t x = 0; x < kSide; ++x) {
        const bool card = std::max(std::abs(x + 0.5 - 100), std::abs(y + 0.5 - 100)) < 25;
        image.pixels.push_back(card ? 4.0f : y < kSide / 4 ? 0.0f : 10.0f);
      }
    }
    return image;
  }
  // Places are from the eye: right, up, and -z ahead.
  grisaille_hit cast(const glm::dvec3& from, const glm::dvec3& towards, float reach = kInfinity) {
    return castOne(rays_, rayFrom(camera().eye + from, towards, reach));
  }
  void expectHit(const glm::dvec3& from, const glm::dvec3& towards, double distance) {
    const grisaille_hit hit = cast(from, towards);
    ASSERT_EQ(hit.kind, uint32_t{GRISAILLE_HIT_SURFACE});
    EXPECT_NEAR(hit.distance, distance, 1e-4 * distance);
    EXPECT_EQ(hit.normal[2], 1);
  }
  void expectKind(grisaille_hit_kind kind, const glm::dvec3& from, const glm::dvec3& towards,
                  float reach = kInfinity) {
    const grisaille_hit hit = cast(from, towards, reach);
    EXPECT_EQ(hit.kind, uint32_t{kind});
    EXPECT_EQ(hit.distance, 0);
  }

  frame::DepthRays rays_;
};

TEST_F(DrawnRays, HitsTheFacetItself) {
  expectHit({0, 0, 0}, {0.5, 0.5, -4}, std::sqrt(16.5));
  expectHit({0, 0, 0}, {5, -5, -10}, std::sqrt(150.0));
  expectHit({-1.5, 0, -2}, {1.5, 0, -2}, 2.5);
  expectHit({-4, -4, -6}, {0, 1, -4}, std::sqrt(17.0));
  expectKind(GRISAILLE_HIT_NONE, {-1.5, 0, -2}, {1.5, 0, -2}, 2.49f);
}

TEST_F(DrawnRays, WhatIsHiddenIsUnknown) {
  // Behind the card, from before it, from behind it, and straight past it to the wall.
  expectKind(GRISAILLE_HIT_UNKNOWN, {-4, 0, -6}, {1, 0, 0});
  expectKind(GRISAILLE_HIT_UNKNOWN, {0, 0, -5}, {0, 0, -1});
  expectKind(GRISAILLE_HIT_UNKNOWN, {0, 0, -11}, {0, 0, -1}, 1);
  expectKind(GRISAILLE_HIT_UNKNOWN, {-4, -2, -4.5}, {6, 3, -1});
  expectHit({-4, -2, -4.5}, {1, -1, -3}, std::sqrt(11.0) * 5.5 / 3);
  // In front of it all, or short of the card's picture.
  expectKind(GRISAILLE_HIT_NONE, {-2, 0, -3}, {1, 0, 0}, 4);
  expectKind(GRISAILLE_HIT_NONE, {-4, 0, -6}, {1, 0, 0}, 2);
}

TEST_F(DrawnRays, ThePicturesEdgeIsTheEndOfKnowledge) {
  expectKind(GRISAILLE_HIT_UNKNOWN, {0, 0, -3}, {1, 0, 0});
  expectKind(GRISAILLE_HIT_NONE, {0, 0, -3}, {1, 0, 0}, 2.9f);
  expectKind(GRISAILLE_HIT_UNKNOWN, {0, 0, -3}, {1, 0, 0}, 3.1f);
  expectKind(GRISAILLE_HIT_UNKNOWN, {-4, 0, -3}, {1, 0, 0});
  expectKind(GRISAILLE_HIT_UNKNOWN, {0, 0, 3}, {0, 0, -1});
  expectKind(GRISAILLE_HIT_UNKNOWN, {0, 0, -3}, {0, 0, 1});
  expectKind(GRISAILLE_HIT_NONE, {0, 0, -3}, {0, 0, 1}, 2.8f);
  // The sky is free, for ever.
  expectKind(GRISAILLE_HIT_NONE, {0, 0, 0}, {0, 3, -4});
  expectKind(GRISAILLE_HIT_NONE, {0, 7, -8}, {0.1, 3, -4});
}

TEST_F(DrawnRays, NothingIsWithinTheNearPlanesDistance) {
  for (const glm::dvec3 towards : {glm::dvec3(0, 0, -1), {1, 0, 0}, {1, 0, 1}, {-1, 1, -0.1}}) {
    expectKind(GRISAILLE_HIT_NONE, {0, 0, 0}, towards, 0.99f * kNear);
  }
  expectKind(GRISAILLE_HIT_NONE, {0, 0, 0}, {0.9, 0, -1}, 1.3f * kNear);
  expectKind(GRISAILLE_HIT_UNKNOWN, {0, 0, 0}, {1, 0, 0}, 1.01f * kNear);
  expectKind(GRISAILLE_HIT_UNKNOWN, {0, 0, 0}, {1.1, 0, -1});
  expectKind(GRISAILLE_HIT_NONE, {0, 0, -3}, {0, 0, 1}, 3.05f);
}

TEST_F(DrawnRays, BrokenFramesAreRefusedOrTellNothing) {
  EXPECT_ERROR(ErrorId::kImageMismatch, frame::DepthRays(draw(), normals(kSide - 1), camera()));
  scene::Camera blind = camera();
  blind.target = blind.eye;
  EXPECT_ERROR(ErrorId::kCameraInvalid, frame::DepthRays(draw(), normals(kSide), blind));
  image::Image broken = draw();
  for (float& metres : broken.pixels) metres = metres == 4 ? std::nanf("") : -metres;
  frame::DepthRays rays(broken, normals(kSide), camera());
  for (const glm::dvec3 towards : {glm::dvec3(0, 0, -1), {1, 0.1, -2}}) {
    EXPECT_EQ(castOne(rays, rayFrom(camera().eye, towards)).kind, uint32_t{GRISAILLE_HIT_UNKNOWN});
  }
}

}  // namespace
}  // namespace grisaille
