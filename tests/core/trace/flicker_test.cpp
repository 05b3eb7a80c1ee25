// SPDX-License-Identifier: MIT
#include "core/trace/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "tests/core/trace/scene_builder.h"
#include "tests/support/expect_error.h"

namespace grisaille::trace {
namespace {

constexpr uint32_t kFlickerWidth = 48;
constexpr uint32_t kFlickerHeight = 32;

// A camera that walks past a sphere on a floor. `ao(frame, hit)` and `truth(frame, hit)` fill the
// pictures.
template <typename Ao, typename TruthOf>
std::vector<FlickerFrame> walk(size_t frames, double step, const Ao& ao, const TruthOf& truth) {
  SceneBuilder builder;
  const uint32_t material = builder.material({});
  builder.place(builder.floor(glm::vec3(0), 20, material));
  builder.place(builder.sphere({0, 0.4f, 0}, 0.4f, material));
  std::vector<FlickerFrame> path(frames);
  for (size_t i = 0; i < frames; ++i) {
    const double x = step * static_cast<double>(i);
    FlickerFrame& frame = path[i];
    frame.camera = cameraAt({1 + x, 1, 1.5}, {x, 0.3, 0});
    frame.hits = RayTracer(builder.scene, frame.camera.eye)
                     .castPrimary(frame.camera, kFlickerWidth, kFlickerHeight);
    for (image::Image* image : {&frame.ao, &frame.truth}) {
      *image = {.width = kFlickerWidth, .height = kFlickerHeight, .channels = 1, .pixels = {}};
      for (const Hit& hit : frame.hits) {
        image->pixels.push_back(
            static_cast<float>(image == &frame.ao ? ao(i, hit) : truth(i, hit)));
      }
    }
  }
  return path;
}

double shade(size_t, const Hit& hit) {
  return 0.5 + 0.3 * std::sin(9 * hit.position.x);
}
double plain(size_t, const Hit&) {
  return 0.75;
}

TEST(Flicker, AConstantPictureHasNone) {
  const Flicker f = flicker(walk(3, 0.05, plain, plain));
  EXPECT_EQ(f.rms, 0);
  EXPECT_GT(f.points, size_t{kFlickerWidth} * kFlickerHeight);
}

TEST(Flicker, TheTruthHasNoneOnAnyPath) {
  for (const double step : {0.0, 0.05, 0.3}) {
    EXPECT_EQ(flicker(walk(3, step, shade, shade)).rms, 0) << step;
  }
}

TEST(Flicker, ASteadyErrorHasNoneWhereNothingMoves) {
  EXPECT_NEAR(flicker(walk(3, 0, shade, plain)).rms, 0, 1e-7);
}

TEST(Flicker, AlternatingByAIsTwiceA) {
  const auto alternating = [](size_t frame, const Hit& hit) {
    return shade(frame, hit) + (frame % 2 == 0 ? 0.125 : -0.125);
  };
  for (const double step : {0.0, 0.05}) {
    EXPECT_NEAR(flicker(walk(4, step, alternating, shade)).rms, 0.25, 1e-6) << step;
  }
}

// One pair of frames with a jump and one without: the mean is over both.
TEST(Flicker, PairsOfFramesWeighBySharedPoints) {
  const auto once = [](size_t frame, const Hit&) { return frame == 0 ? 0.5 : 0.9; };
  const Flicker f = flicker(walk(3, 0, once, plain));
  EXPECT_NEAR(f.rms, 0.4 / std::sqrt(2.0), 1e-6);
}

TEST(Flicker, OnlyPointsThatTheNextFrameShowsCount) {
  const auto all = walk(2, 0, plain, plain);
  size_t surfaces = 0;
  for (const Hit& hit : all[0].hits) surfaces += hit.viewDepth > 0 ? 1 : 0;
  EXPECT_EQ(flicker(all).points, surfaces);
  // A far camera shares no point; for a camera turned round, all points lie behind the eye.
  EXPECT_EQ(flicker(walk(2, 60, plain, plain)).points, 0u);
  auto turned = all;
  turned[1].camera.target = 2.0 * turned[1].camera.eye - turned[1].camera.target;
  EXPECT_EQ(flicker(turned).points, 0u);

  // Points that the sphere hides in a neighbouring frame do not count: the floor just behind it.
  auto aside = walk(2, 0.4, plain, plain);
  for (Hit& hit : aside[0].hits) {
    const glm::dvec3 eye = aside[1].camera.eye;
    const glm::dvec3 toward = glm::normalize(eye - hit.position);
    const double along = glm::dot(glm::dvec3(0, 0.4, 0) - hit.position, toward);
    const glm::dvec3 nearest = hit.position + along * toward - glm::dvec3(0, 0.4, 0);
    const bool hidden = along > 0.1 && glm::length(nearest) < 0.3;
    if (hit.viewDepth > 0 && !hidden) hit.viewDepth = 0;
  }
  EXPECT_EQ(flicker(aside).points, 0u);
}

TEST(Flicker, ValuesThatAreNotFiniteAreLeftOut) {
  auto frames = walk(2, 0, plain, plain);
  const uint64_t all = flicker(frames).points;
  const size_t pixel = kFlickerWidth * kFlickerHeight - kFlickerWidth / 2;  // a pixel on the floor
  frames[1].truth.pixels[pixel] = std::numeric_limits<float>::quiet_NaN();
  frames[0].ao.pixels[pixel - 1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(flicker(frames).points, all - 2);
  EXPECT_EQ(flicker(frames).rms, 0);
}

// The map holds the values that enter the RMS, point by point.
TEST(Flicker, TheMapOfChangesIsWhatTheRmsIsOver) {
  const auto alternating = [](size_t frame, const Hit& hit) {
    return shade(frame, hit) + (frame % 2 == 0 ? 0.1 * hit.position.x : 0);
  };
  const auto frames = walk(2, 0.05, alternating, shade);
  const Flicker f = flicker(frames);
  const image::Image map = changeBetween(frames[0], frames[1]);
  double squares = 0;
  uint64_t points = 0;
  for (size_t i = 0; i < map.pixels.size(); ++i) {
    if (std::isnan(map.pixels[i])) continue;
    ++points;
    squares += double{map.pixels[i]} * double{map.pixels[i]};
    EXPECT_NEAR(map.pixels[i], -0.1 * frames[0].hits[i].position.x, 1e-6);
  }
  EXPECT_EQ(points, f.points);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(points)), f.rms, 1e-6);
}

TEST(Flicker, FewerThanTwoFramesAndOtherShapes) {
  auto frames = walk(2, 0, plain, plain);
  EXPECT_EQ(flicker({}).points, 0u);
  EXPECT_EQ(flicker(std::span(frames).first(1)).points, 0u);
  frames[1].truth.width = kFlickerWidth / 2;
  EXPECT_ERROR(ErrorId::kImageMismatch, flicker(frames));
}

}  // namespace
}  // namespace grisaille::trace
