// SPDX-License-Identifier: MIT
// Visibility accumulated over frames, on every backend.
#include <gtest/gtest.h>

#include "tests/effects/ssao/render_ao.h"
#include "tests/support/devices.h"
#include "tests/support/moving_scenes.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

using tests::AoFrames;
using tests::Settings;

constexpr uint32_t kWidth = 96, kHeight = 72;
// Without a blur, the noise of a frame stays visible.
const Settings kNoisy = {{"blur_size", "0"}, {"resolution", "full"}, {"history", "32"}};

class HistoryTest : public tests::BackendTest {
 protected:
  // Reference: one frame with 32 slices per pixel.
  image::Image still(const scene::Camera& camera, uint32_t width = kWidth,
                     uint32_t height = kHeight) {
    return tests::renderAo(
        device(), scene_, camera,
        {{"blur_size", "0"}, {"resolution", "full"}, {"slices", "32"}, {"kernel_size", "384"}},
        width, height);
  }
  // Root mean square error against still().
  double errorOf(const image::Image& ao, const scene::Camera& camera) {
    return image::compare(ao, still(camera, ao.width, ao.height)).rmse;
  }

  const scene::Scene scene_ = tests::cornerScene();
};
GRISAILLE_ON_EVERY_DEVICE(HistoryTest);

scene::Camera cameraAt(double x, double z = 1.5) {
  return {.eye = glm::dvec3(x, 1.2, z), .target = glm::dvec3(x, 0, 0)};
}

TEST_P(HistoryTest, NoiseFallsWhileNothingMoves) {
  AoFrames frames(device(), scene_, kNoisy);
  const double first = errorOf(frames.show(cameraAt(0), kWidth, kHeight), cameraAt(0));
  image::Image before, last;
  for (int i = 1; i < 32; ++i) {
    before = std::move(last);
    last = frames.show(cameraAt(0), kWidth, kHeight);
  }
  EXPECT_LT(errorOf(last, cameraAt(0)), 0.2 * first);
  EXPECT_LT(image::compare(last, before).rmse, 0.05 * first);
}

// Running an estimator without a history discards the history.
TEST_P(HistoryTest, AnotherEstimatorEndsIt) {
  AoFrames frames(device(), scene_, kNoisy);
  const image::Image first = frames.show(cameraAt(0), kWidth, kHeight);
  frames.show(cameraAt(0), kWidth, kHeight);
  frames.set({{"estimator", "classic"}});
  frames.show(cameraAt(0), kWidth, kHeight);
  frames.set({{"estimator", "slices"}});
  EXPECT_EQ(frames.show(cameraAt(0), kWidth, kHeight).pixels, first.pixels);
}

// With `history` 1, each frame is independent and has the noise pattern of the first.
TEST_P(HistoryTest, WithoutItFramesStandAlone) {
  Settings settings = kNoisy;
  settings.back().second = "1";
  AoFrames frames(device(), scene_, settings);
  const image::Image first = frames.show(cameraAt(0), kWidth, kHeight);
  frames.show(cameraAt(0.3), kWidth, kHeight);
  EXPECT_EQ(frames.show(cameraAt(0), kWidth, kHeight).pixels, first.pixels);
}

TEST_P(HistoryTest, AMovingCameraKeepsWhatItSaw) {
  for (const char* resolution : {"full", "half"}) {
    // Refined pixels have no history.
    AoFrames frames(device(), scene_, kNoisy);
    frames.set({{"resolution", resolution}, {"refine", "nothing"}});
    const auto at = [](int i) { return cameraAt(0.011 * i, 1.5 - 0.007 * i); };  // parts of pixels
    const double first = errorOf(frames.show(at(0), kWidth, kHeight), at(0));
    for (int i = 1; i < 15; ++i) frames.show(at(i), kWidth, kHeight);
    const double last = errorOf(frames.show(at(15), kWidth, kHeight), at(15));
    EXPECT_LT(last, 0.5 * first) << resolution;
  }
}

// A post in front of a wall. The wall that it uncovers has no history; the post must not inherit
// the wall's.
TEST_P(HistoryTest, WhatWasCoveredLeavesNoGhost) {
  scene::Scene scene = tests::wallScene();
  tests::addQuad(scene,
                 {glm::vec3(-0.2f, -3, 1.2f), {0.2f, -3, 1.2f}, {0.2f, 3, 1.2f}, {-0.2f, 3, 1.2f}},
                 {0, 0, 1});
  const auto at = [](int i) {
    return scene::Camera{.eye = glm::dvec3(0.05 * i, 0, 4), .target = glm::dvec3(0, 0, 0)};
  };
  AoFrames moving(device(), scene, {{"history", "32"}});
  image::Image last;
  for (int i = 0; i <= 20; ++i) last = moving.show(at(i), kWidth, kHeight);
  const image::Image alone = tests::renderAo(device(), scene, at(20), {}, kWidth, kHeight);
  EXPECT_LT(image::compare(last, alone).largest, 0.02);
}

const scene::Camera kBesideTheBox = {.eye = glm::dvec3(0.6, 1.3, 2.6),
                                     .target = glm::dvec3(0.2, 0.2, 0.3)};

// A box that slides by 6 cm a frame. The floor and the wall beside it rest, but their visibility
// changes.
TEST_P(HistoryTest, AMovingBoxLeavesNoGhost) {
  for (const char* resolution : {"full", "half"}) {
    for (const char* guard : {"0", "0.1"}) {
      const Settings alone = {{"resolution", resolution}, {"guard_band", guard}};
      Settings averaged = alone;
      averaged.emplace_back("history", "32");
      scene::Scene scene = tests::boxOnFloor(-1.2);
      AoFrames frames(device(), scene, averaged);
      image::Image last;
      for (int i = 0; i <= 24; ++i) {
        tests::moveBox(scene, -1.2 + 0.06 * i);
        last = frames.show(kBesideTheBox, kWidth, kHeight);
      }
      const auto render = [&](const Settings& settings) {
        return tests::renderAo(device(), scene, kBesideTheBox, settings, kWidth, kHeight);
      };
      const image::Image best = render({{"resolution", "full"},
                                        {"slices", "32"},
                                        {"kernel_size", "768"},
                                        {"blur_size", "0"},
                                        {"guard_band", guard}});
      EXPECT_LT(image::compare(last, best).rmse, image::compare(render(alone), best).rmse + 0.0035)
          << resolution << " " << guard;
    }
  }
}

// The history of a moving surface goes with it: on the face of a box that comes nearer, noise falls
// as it does at rest.
TEST_P(HistoryTest, AMovingSurfaceKeepsItsHistory) {
  const scene::Camera camera = {.eye = glm::dvec3(3, 0.5, 0.7),
                                .target = glm::dvec3(0.3, 0.3, 0.5)};
  scene::Scene scene = tests::boxOnFloor(-0.6);
  AoFrames frames(device(), scene, kNoisy);
  image::Image last, motion;
  for (int i = 0; i < 16; ++i) {
    tests::moveBox(scene, -0.6 + 0.06 * i);
    std::vector<image::Image> images = frames.showAll(camera, kWidth, kHeight, {"ao", "motion"});
    last = std::move(images[0]);
    motion = std::move(images[1]);
  }
  const auto onBox = [&](const scene::Scene& from, const image::Image& ao) {
    const image::Image reference = tests::renderAo(
        device(), from, camera,
        {{"blur_size", "0"}, {"resolution", "full"}, {"slices", "32"}, {"kernel_size", "384"}},
        kWidth, kHeight);
    double sum = 0;
    int count = 0;
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        if (motion.at(x, y, 3) != 2) continue;
        const double error = double{ao.at(x, y)} - reference.at(x, y);
        sum += error * error;
        ++count;
      }
    }
    EXPECT_GT(count, 200);
    return std::sqrt(sum / count);
  };
  const image::Image alone = tests::renderAo(device(), scene, camera, kNoisy, kWidth, kHeight);
  EXPECT_LT(onBox(scene, last), 0.5 * onBox(scene, alone));
}

// The visibility of surfaces that no movement reaches is that of a scene at rest, to the last bit.
TEST_P(HistoryTest, MovementChangesOnlyWhatItReaches) {
  const auto leftmost = [&](double step) {
    scene::Scene scene = tests::boxOnFloor(0.9);
    AoFrames frames(device(), scene, {{"history", "8"}, {"radius", "0.2"}});
    image::Image last;
    for (int i = 0; i < 6; ++i) {
      tests::moveBox(scene, 0.9 + step * i);
      last = frames.show(kBesideTheBox, kWidth, kHeight);
    }
    std::vector<float> values;
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth / 4; ++x) values.push_back(last.at(x, y));
    }
    return values;
  };
  EXPECT_EQ(leftmost(0.01), leftmost(0));
}

TEST_P(HistoryTest, ANewSizeOrResolutionDoesNotFlash) {
  AoFrames frames(device(), scene_, kNoisy);
  for (int i = 0; i < 32; ++i) frames.show(cameraAt(0), kWidth, kHeight);
  for (const auto& [width, height] : {std::pair{120u, 91u}, {61u, 47u}, {96u, 96u}}) {
    const image::Image ao = frames.show(cameraAt(0), width, height);
    const image::Image fresh =
        tests::renderAo(device(), scene_, cameraAt(0), kNoisy, width, height);
    EXPECT_LT(errorOf(ao, cameraAt(0)), 0.5 * errorOf(fresh, cameraAt(0)))
        << width << "x" << height;
  }
  // Texels of half the resolution show the same surfaces.
  for (int i = 0; i < 32; ++i) frames.show(cameraAt(0), kWidth, kHeight);
  const image::Image full = frames.show(cameraAt(0), kWidth, kHeight);
  frames.set({{"resolution", "half"}});
  const image::Image half = frames.show(cameraAt(0), kWidth, kHeight);
  EXPECT_LT(image::compare(half, full).rmse, 0.03);
}

TEST_P(HistoryTest, OtherSettingsStartAfresh) {
  AoFrames frames(device(), scene_, kNoisy);
  for (int i = 0; i < 8; ++i) frames.show(cameraAt(0), kWidth, kHeight);
  frames.set({{"radius", "0.2"}});
  const image::Image changed = frames.show(cameraAt(0), kWidth, kHeight);
  Settings fresh = kNoisy;
  fresh.emplace_back("radius", "0.2");
  EXPECT_EQ(changed.pixels,
            tests::renderAo(device(), scene_, cameraAt(0), fresh, kWidth, kHeight).pixels);
}

TEST_P(HistoryTest, CutsAndExtremesStayVisibilities) {
  AoFrames frames(device(), scene_, {{"history", "256"}});
  const std::vector<scene::Camera> cameras = {
      cameraAt(0),
      {.eye = glm::dvec3(0, 1.2, 1.5), .target = glm::dvec3(0, 1.2, 9)},  // away from everything
      cameraAt(0),
      {.eye = glm::dvec3(0, 1.2, 1.5), .target = glm::dvec3(0, 0, 0), .fovyDegrees = 1},
      {.eye = glm::dvec3(0, 1.2, 1.5), .target = glm::dvec3(0, 0, 0), .fovyDegrees = 170},
      {.eye = glm::dvec3(0, 1e5, 1e5), .target = glm::dvec3(0, 0, 0)},
      {.eye = glm::dvec3(0, 0.001, 0.5), .target = glm::dvec3(0, 0, 0)}};
  for (const scene::Camera& camera : cameras) {
    for (const auto& [width, height] : {std::pair{33u, 17u}, {1u, 1u}, {1u, 64u}, {65u, 2u}}) {
      tests::expectVisibility(frames.show(camera, width, height),
                              fmt::format("{}x{}", width, height));
    }
  }
}

// Far from the world's origin, the camera's moves are as small relative to its position as
// possible.
TEST_P(HistoryTest, FarFromTheOriginItIsTheSame) {
  const auto walk = [&](const glm::dvec3& origin) {
    scene::Scene scene = scene_;
    for (scene::Instance& instance : scene.instances) {
      instance.worldFromObject[3] += glm::dvec4(origin, 0);
    }
    scene::computeBounds(scene);
    AoFrames frames(device(), scene, kNoisy);
    image::Image last;
    for (int i = 0; i < 8; ++i) {
      scene::Camera camera = cameraAt(0.0625 * i);
      camera.eye += origin;
      camera.target += origin;
      last = frames.show(camera, kWidth, kHeight);
    }
    return last;
  };
  EXPECT_LT(image::compare(walk({}), walk({2e6, -1e6, 3e6})).rmse, 0.003);
}

}  // namespace
}  // namespace grisaille
