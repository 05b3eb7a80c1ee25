// SPDX-License-Identifier: MIT
// The classic SSAO with its public settings, on every backend.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/effects/ssao/render_ao.h"
#include "tests/support/devices.h"
#include "tests/support/expect_error.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

using tests::kAoHeight;
using tests::kAoWidth;
using tests::meanRows;

// The classic estimator with its usual intensity: twice the plain average.
image::Image renderClassic(gpu::Device& device, const scene::Scene& scene,
                           const scene::Camera& camera, const tests::Settings& settings) {
  tests::Settings all = {
      {"estimator", "classic"}, {"kernel_size", "64"}, {"blur_size", "4"}, {"intensity", "2"}};
  all.insert(all.end(), settings.begin(), settings.end());
  return tests::renderAo(device, scene, camera, all);
}

const scene::Camera kDown = {.eye = glm::dvec3(0, 2, 0), .target = glm::dvec3(0, 0, -2)};
// Looks at the crease of cornerScene(), which runs through the picture's middle row.
const scene::Camera kCrease = {.eye = glm::dvec3(0, 2, 2), .target = glm::dvec3(0, 0, 0)};

class SsaoTest : public tests::BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(SsaoTest);

TEST_P(SsaoTest, EverySettingGivesVisibilities) {
  const scene::Scene scene = tests::cornerScene();
  for (const char* sampling : {"hemisphere", "sphere"}) {
    for (const char* rotation : {"noise", "none"}) {
      for (const char* range : {"linear", "raw_depth", "none"}) {
        for (const char* blur : {"box", "edge_aware"}) {
          tests::expectVisibility(renderClassic(device(), scene, kCrease,
                                                {{"sampling", sampling},
                                                 {"rotation", rotation},
                                                 {"range_check", range},
                                                 {"blur", blur},
                                                 {"kernel_size", "5"}}),
                                  std::string(sampling) + rotation + range + blur);
        }
      }
    }
  }
}

TEST_P(SsaoTest, ExtremesStayVisibilities) {
  const scene::Scene scene = tests::cornerScene();
  const std::vector<tests::Settings> extremes = {
      {{"kernel_size", "1"}},
      {{"kernel_size", "256"}},
      {{"kernel_size", "1001"}},
      {{"radius", "1e-6"}},
      {{"radius", "1e6"}},
      {{"bias", "0"}},
      {{"bias", "1e6"}},
      {{"blur_size", "0"}},
      {{"blur_size", "20"}},
      {{"intensity", "0"}},
      {{"intensity", "10"}},
      {{"power", "0.1"}},
      {{"power", "10"}},
      {{"seed", "65535"}},
      {{"radius", "1e6"}, {"sampling", "sphere"}},
      {{"radius", "1e-6"}, {"blur", "edge_aware"}, {"blur_size", "20"}}};
  for (const tests::Settings& settings : extremes) {
    tests::expectVisibility(renderClassic(device(), scene, kCrease, settings),
                            settings[0].first + settings[0].second);
  }
}

TEST_P(SsaoTest, SkyIsFullyOpen) {
  const scene::Camera horizon = {.eye = glm::dvec3(0, 0.3, 0), .target = glm::dvec3(0, 0.3, -1)};
  for (const tests::Settings& settings : std::vector<tests::Settings>{
           {}, {{"sampling", "sphere"}}, {{"blur_size", "20"}}, {{"blur", "edge_aware"}}}) {
    const image::Image ao = renderClassic(device(), tests::floorScene(), horizon, settings);
    for (uint32_t y = 0; y < kAoHeight / 2 - 1; ++y) {
      for (uint32_t x = 0; x < kAoWidth; ++x) ASSERT_EQ(ao.at(x, y), 1.0f) << x << " " << y;
    }
  }
}

TEST_P(SsaoTest, FlatFloorIsOpenInTheHemisphereAndHalfShutInTheSphere) {
  const scene::Scene scene = tests::floorScene();
  EXPECT_GT(meanRows(renderClassic(device(), scene, kDown, {}), 0, kAoHeight), 0.98);
  const double sphere =
      meanRows(renderClassic(device(), scene, kDown, {{"sampling", "sphere"}, {"intensity", "1"}}),
               0, kAoHeight);
  EXPECT_GT(sphere, 0.4);
  EXPECT_LT(sphere, 0.65);
}

TEST_P(SsaoTest, CreaseIsDarkAndTheOpenFloorIsNot) {
  const image::Image ao = renderClassic(device(), tests::cornerScene(), kCrease, {});
  EXPECT_LT(meanRows(ao, kAoHeight / 2 - 2, kAoHeight / 2 + 2), 0.8);
  EXPECT_GT(meanRows(ao, kAoHeight - 8, kAoHeight), 0.97);
}

TEST_P(SsaoTest, IntensityAndPowerOrderTheDarkness) {
  const scene::Scene scene = tests::cornerScene();
  const auto crease = [&](const tests::Settings& settings) {
    return meanRows(renderClassic(device(), scene, kCrease, settings), kAoHeight / 2 - 2,
                    kAoHeight / 2 + 2);
  };
  EXPECT_EQ(crease({{"intensity", "0"}}), 1.0);
  EXPECT_GT(crease({{"intensity", "0.5"}}), crease({}));
  EXPECT_GT(crease({}), crease({{"intensity", "3"}}));
  EXPECT_GT(crease({}), crease({{"power", "2"}}));
  EXPECT_LT(crease({{"blur_size", "0"}, {"power", "2"}}), crease({{"blur_size", "0"}}));
}

TEST_P(SsaoTest, OneSeedGivesTheSameBitsAndAnotherDoesNot) {
  const scene::Scene scene = tests::cornerScene();
  const image::Image first = renderClassic(device(), scene, kCrease, {{"seed", "7"}});
  EXPECT_EQ(first.pixels, renderClassic(device(), scene, kCrease, {{"seed", "7"}}).pixels);
  EXPECT_NE(first.pixels, renderClassic(device(), scene, kCrease, {{"seed", "8"}}).pixels);
}

TEST_P(SsaoTest, BlurOfTheNoisesSizeRemovesItsPattern) {
  const scene::Scene scene = tests::cornerScene();
  const auto roughness = [&](const tests::Settings& settings) {
    const image::Image ao = renderClassic(device(), scene, kCrease, settings);
    double sum = 0;
    const uint32_t row = kAoHeight / 2 + 2;
    for (uint32_t x = 1; x < kAoWidth; ++x) sum += std::abs(ao.at(x, row) - ao.at(x - 1, row));
    return sum;
  };
  const tests::Settings few = {{"kernel_size", "8"}, {"blur_size", "0"}};
  EXPECT_LT(roughness({{"kernel_size", "8"}, {"blur_size", "4"}}), 0.3 * roughness(few));
}

TEST_P(SsaoTest, EdgeAwareBlurKeepsTheSkylineAndBoxDoesNotDarkenIt) {
  // A post in front of the sky, its foot on the floor: the floor far behind it must not be
  // darkened.
  scene::Scene scene = tests::floorScene();
  tests::addQuad(scene, {glm::vec3(-0.2f, 0, 1), {0.2f, 0, 1}, {0.2f, 3, 1}, {-0.2f, 3, 1}},
                 {0, 0, 1});
  const scene::Camera camera = {.eye = glm::dvec3(0, 1.5, 4), .target = glm::dvec3(0, 1.4, 0)};
  const image::Image ao = renderClassic(
      device(), scene, camera, {{"blur", "edge_aware"}, {"blur_size", "8"}, {"radius", "0.3"}});
  EXPECT_GT(ao.at(kAoWidth / 2, kAoHeight / 2), 0.97f);
}

// A slab of 14 cm on a floor.
scene::Scene slabScene() {
  scene::Scene scene = tests::floorScene();
  tests::addBox(scene, glm::translate(glm::dmat4(1), glm::dvec3(0, 0.04, 0)) *
                           glm::scale(glm::dmat4(1), glm::dvec3(0.5, 0.1, 0.5)));
  return scene;
}

// The knobs that everyone knows, for both estimators.
TEST_P(SsaoTest, EachKnobChangesThePicture) {
  const scene::Scene scene = slabScene();
  for (const char* estimator : {"slices", "classic"}) {
    const auto rendered = [&](const char* key, const char* value) {
      return tests::renderAo(device(), scene, kCrease, {{"estimator", estimator}, {key, value}});
    };
    const image::Image usual = rendered("intensity", "1");
    for (const auto& [key, value] :
         {std::pair{"kernel_size", "2"}, {"radius", "0.7"}, {"bias", "0.05"}, {"blur_size", "4"}}) {
      EXPECT_GT(image::shareOver(rendered(key, value), usual, 2.0 / 255), 0.005)
          << estimator << ' ' << key;
    }
  }
}

TEST_P(SsaoTest, WhatIsLowerThanTheBiasDoesNotOcclude) {
  const scene::Scene scene = slabScene();
  const scene::Camera above = {
      .eye = glm::dvec3(0, 3, 0), .target = glm::dvec3(0), .up = glm::dvec3(0, 0, -1)};
  for (const tests::Settings& setting :
       std::vector<tests::Settings>{{{"resolution", "full"}, {"kernel_size", "24"}},
                                    {{"resolution", "half"}},
                                    {{"resolution", "quarter"}},
                                    {{"backs", "drawn"}},
                                    {{"estimator", "classic"}, {"kernel_size", "64"}}}) {
    const auto darkest = [&](const char* bias) {
      tests::Settings all = setting;
      all.emplace_back("bias", bias);
      const image::Image ao = tests::renderAo(device(), scene, above, all, 160, 120);
      return *std::ranges::min_element(ao.pixels);
    };
    EXPECT_LT(darkest("0"), 0.95f) << setting[0].second;
    EXPECT_LT(darkest("0.1"), 0.99f) << setting[0].second;
    EXPECT_GT(darkest("0.1"), darkest("0") + 0.02f) << setting[0].second;
    // Slices continue the line through the last two taps, which may rise over the slab.
    EXPECT_GT(darkest("0.15"), 0.99f) << setting[0].second;
  }
}

TEST(SsaoBackends, Agree) {
  const std::vector<tests::TestDevice> backends = tests::presentSystemDevices();
  if (backends.size() < 2) GTEST_SKIP() << "only one backend is present";
  for (const tests::Settings& settings : std::vector<tests::Settings>{{},
                                                                      {{"sampling", "sphere"}},
                                                                      {{"blur_size", "0"}},
                                                                      {{"kernel_size", "600"}},
                                                                      {{"bias", "0.02"}}}) {
    std::vector<image::Image> images;
    for (const tests::TestDevice& backend : backends) {
      const auto device = tests::openDevice(backend);
      images.push_back(renderClassic(*device, tests::cornerScene(), kCrease, settings));
    }
    EXPECT_LT(image::shareOver(images[0], images[1], 2.0 / 255), 0.001);
  }
}

TEST(SsaoTable, RefusesWhatItDoesNotAllow) {
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  effect::Values values(registry.find("ssao"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("kernel_size", "4097"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("kernel_size", "0"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("radius", "0"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("blur_size", "21"));
  EXPECT_ERROR(ErrorId::kParameterType, values.set("kernel_size", "6.5"));
  EXPECT_ERROR(ErrorId::kParameterUnknown, values.set("kernelsize", "6"));
  EXPECT_EQ(values.get("kernel_size"), 16);
}

}  // namespace
}  // namespace grisaille
