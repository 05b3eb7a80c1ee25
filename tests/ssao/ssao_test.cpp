// SPDX-License-Identifier: MIT
// The classic SSAO as its users see it, on every backend.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/frame/renderer.h"
#include "tests/support/devices.h"
#include "tests/support/expect_error.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 72;

image::Image renderAo(gpu::Device& device, const scene::Scene& scene, const scene::Camera& camera,
                      const Settings& settings) {
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  effect::Values values(registry.find("ssao"));
  for (const auto& [key, value] : settings) values.set(key, value);
  effect::Instance instance(device, registry.find("ssao"));
  frame::Renderer renderer(device, scene);
  const std::array effects = {frame::ActiveEffect{.instance = &instance, .values = &values}};
  const std::vector<std::string> outputs = {"ao"};
  renderer.render({.camera = camera,
                   .width = kWidth,
                   .height = kHeight,
                   .effects = effects,
                   .outputs = outputs});
  return renderer.read("ao");
}

double mean(const image::Image& image, uint32_t fromRow, uint32_t toRow) {
  double sum = 0;
  for (uint32_t y = fromRow; y < toRow; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) sum += image.at(x, y);
  }
  return sum / (image.width * (toRow - fromRow));
}

void expectVisibility(const image::Image& image, const std::string& what) {
  for (const float value : image.pixels) {
    ASSERT_TRUE(std::isfinite(value) && value >= 0 && value <= 1) << value << " with " << what;
  }
}

const scene::Camera kDown = {.eye = glm::dvec3(0, 2, 0), .target = glm::dvec3(0, 0, -2)};
// Looks at the crease of cornerScene(); its row runs through the middle of the picture.
const scene::Camera kCrease = {.eye = glm::dvec3(0, 2, 2), .target = glm::dvec3(0, 0, 0)};

class SsaoTest : public tests::BackendTest {};
GRISAILLE_ON_EVERY_BACKEND(SsaoTest);

TEST_P(SsaoTest, EverySettingGivesVisibilities) {
  const scene::Scene scene = tests::cornerScene();
  for (const char* sampling : {"hemisphere", "sphere"}) {
    for (const char* rotation : {"noise", "none"}) {
      for (const char* range : {"linear", "raw_depth", "none"}) {
        for (const char* blur : {"box", "edge_aware"}) {
          expectVisibility(renderAo(device(), scene, kCrease,
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
  const std::vector<Settings> extremes = {
      {{"kernel_size", "1"}},
      {{"kernel_size", "256"}},
      {{"radius", "1e-6"}},
      {{"radius", "1e6"}},
      {{"bias", "0"}},
      {{"bias", "1e6"}},
      {{"blur_size", "0"}},
      {{"blur_size", "16"}},
      {{"intensity", "0"}},
      {{"intensity", "10"}},
      {{"power", "0.1"}},
      {{"power", "10"}},
      {{"seed", "65535"}},
      {{"radius", "1e6"}, {"sampling", "sphere"}},
      {{"radius", "1e-6"}, {"blur", "edge_aware"}, {"blur_size", "16"}}};
  for (const Settings& settings : extremes) {
    expectVisibility(renderAo(device(), scene, kCrease, settings),
                     settings[0].first + settings[0].second);
  }
}

TEST_P(SsaoTest, SkyIsFullyOpen) {
  const scene::Camera horizon = {.eye = glm::dvec3(0, 0.3, 0), .target = glm::dvec3(0, 0.3, -1)};
  for (const Settings& settings : std::vector<Settings>{
           {}, {{"sampling", "sphere"}}, {{"blur_size", "16"}}, {{"blur", "edge_aware"}}}) {
    const image::Image ao = renderAo(device(), tests::floorScene(), horizon, settings);
    for (uint32_t y = 0; y < kHeight / 2 - 1; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) ASSERT_EQ(ao.at(x, y), 1.0f) << x << " " << y;
    }
  }
}

TEST_P(SsaoTest, FlatFloorIsOpenInTheHemisphereAndHalfShutInTheSphere) {
  const scene::Scene scene = tests::floorScene();
  EXPECT_GT(mean(renderAo(device(), scene, kDown, {}), 0, kHeight), 0.98);
  const double sphere = mean(
      renderAo(device(), scene, kDown, {{"sampling", "sphere"}, {"intensity", "1"}}), 0, kHeight);
  EXPECT_GT(sphere, 0.4);
  EXPECT_LT(sphere, 0.65);
}

TEST_P(SsaoTest, CreaseIsDarkAndTheOpenFloorIsNot) {
  const image::Image ao = renderAo(device(), tests::cornerScene(), kCrease, {});
  EXPECT_LT(mean(ao, kHeight / 2 - 2, kHeight / 2 + 2), 0.8);
  EXPECT_GT(mean(ao, kHeight - 8, kHeight), 0.97);
}

TEST_P(SsaoTest, IntensityAndPowerOrderTheDarkness) {
  const scene::Scene scene = tests::cornerScene();
  const auto crease = [&](const Settings& settings) {
    return mean(renderAo(device(), scene, kCrease, settings), kHeight / 2 - 2, kHeight / 2 + 2);
  };
  EXPECT_EQ(crease({{"intensity", "0"}}), 1.0);
  EXPECT_GT(crease({{"intensity", "0.5"}}), crease({}));
  EXPECT_GT(crease({}), crease({{"intensity", "3"}}));
  EXPECT_GT(crease({}), crease({{"power", "2"}}));
  EXPECT_LT(crease({{"blur_size", "0"}, {"power", "2"}}), crease({{"blur_size", "0"}}));
}

TEST_P(SsaoTest, OneSeedGivesTheSameBitsAndAnotherDoesNot) {
  const scene::Scene scene = tests::cornerScene();
  const image::Image first = renderAo(device(), scene, kCrease, {{"seed", "7"}});
  EXPECT_EQ(first.pixels, renderAo(device(), scene, kCrease, {{"seed", "7"}}).pixels);
  EXPECT_NE(first.pixels, renderAo(device(), scene, kCrease, {{"seed", "8"}}).pixels);
}

TEST_P(SsaoTest, BlurOfTheNoisesSizeRemovesItsPattern) {
  const scene::Scene scene = tests::cornerScene();
  const auto roughness = [&](const Settings& settings) {
    const image::Image ao = renderAo(device(), scene, kCrease, settings);
    double sum = 0;
    const uint32_t row = kHeight / 2 + 2;
    for (uint32_t x = 1; x < kWidth; ++x) sum += std::abs(ao.at(x, row) - ao.at(x - 1, row));
    return sum;
  };
  const Settings few = {{"kernel_size", "8"}, {"blur_size", "0"}};
  EXPECT_LT(roughness({{"kernel_size", "8"}, {"blur_size", "4"}}), 0.3 * roughness(few));
}

TEST_P(SsaoTest, EdgeAwareBlurKeepsTheSkylineAndBoxDoesNotDarkenIt) {
  // A post before the sky, its foot on the floor: no floor pixel far behind may darken it.
  scene::Scene scene = tests::floorScene();
  tests::addQuad(scene, {glm::vec3(-0.2f, 0, 1), {0.2f, 0, 1}, {0.2f, 3, 1}, {-0.2f, 3, 1}},
                 {0, 0, 1});
  const scene::Camera camera = {.eye = glm::dvec3(0, 1.5, 4), .target = glm::dvec3(0, 1.4, 0)};
  const image::Image ao = renderAo(device(), scene, camera,
                                   {{"blur", "edge_aware"}, {"blur_size", "8"}, {"radius", "0.3"}});
  EXPECT_GT(ao.at(kWidth / 2, kHeight / 2), 0.97f);
}

TEST(SsaoBackends, Agree) {
  const std::vector<std::string> backends = tests::presentBackends();
  if (backends.size() < 2) GTEST_SKIP() << "one backend alone is present";
  for (const Settings& settings :
       std::vector<Settings>{{}, {{"sampling", "sphere"}}, {{"blur_size", "0"}}}) {
    std::vector<image::Image> images;
    for (const std::string& backend : backends) {
      const auto device = tests::openDevice(backend);
      images.push_back(renderAo(*device, tests::cornerScene(), kCrease, settings));
    }
    EXPECT_LT(image::shareOver(images[0], images[1], 2.0 / 255), 0.001);
  }
}

TEST(SsaoTable, RefusesWhatItDoesNotAllow) {
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  effect::Values values(registry.find("ssao"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("kernel_size", "257"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("kernel_size", "0"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("radius", "0"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("blur_size", "17"));
  EXPECT_ERROR(ErrorId::kParameterType, values.set("kernel_size", "6.5"));
  EXPECT_ERROR(ErrorId::kParameterUnknown, values.set("kernelsize", "6"));
  EXPECT_EQ(values.get("kernel_size"), 64);
}

}  // namespace
}  // namespace grisaille
