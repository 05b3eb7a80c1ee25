// SPDX-License-Identifier: MIT
// Open directions and bounced light, on every backend.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/effects/ssao/render_ao.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

using tests::AoFrames;
using tests::Settings;

constexpr uint32_t kLitWidth = 320, kLitHeight = 240;
const scene::Camera kCreaseView = {.eye = glm::dvec3(0, 1.2, 1.5), .target = glm::dvec3(0, 0, 0)};

class LightTest : public tests::BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(LightTest);

glm::dvec3 vectorAt(const image::Image& image, uint32_t x, uint32_t y) {
  return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

// Mean open direction above the floor at a distance from the wall, in radii. Cosine-weighted
// directions are uniform on a disc; the wall blocks those beyond that distance.
glm::dvec3 openOverFloor(double distance) {
  constexpr int kSteps = 400;
  glm::dvec3 sum(0);
  for (int i = 0; i < kSteps; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const double x = (i + 0.5) / kSteps * 2 - 1, z = (k + 0.5) / kSteps * 2 - 1;
      if (x * x + z * z < 1 && z > -distance) sum += glm::dvec3(x, std::sqrt(1 - x * x - z * z), z);
    }
  }
  return glm::normalize(sum);
}

TEST_P(LightTest, BentNormalsOfACornerAreTheAnalyticOnes) {
  const scene::Scene scene = tests::cornerScene();
  for (const char* resolution : {"full", "half"}) {
    AoFrames frames(device(), scene,
                    {{"resolution", resolution}, {"slices", "4"}, {"kernel_size", "48"}});
    const auto images =
        frames.showAll(kCreaseView, kLitWidth, kLitHeight, {"bent_normal", "depth", "normal"});
    const glm::dmat3 axes = scene::worldFromView(kCreaseView);
    const double scale = std::tan(glm::radians(kCreaseView.fovyDegrees) / 2) * 2 / kLitHeight;
    std::array<glm::dvec3, 5> sums = {};
    for (uint32_t y = 0; y < kLitHeight; ++y) {
      for (uint32_t x = 0; x < kLitWidth; ++x) {
        const glm::dvec3 bent = vectorAt(images[0], x, y);
        ASSERT_NEAR(glm::length(bent), 1, 2e-3) << x << ' ' << y;
        const glm::dvec3 ray((x + 0.5 - kLitWidth * 0.5) * scale,
                             (kLitHeight * 0.5 - y - 0.5) * scale, -1);
        const double distance = (kCreaseView.eye + axes * ray * double{images[1].at(x, y)}).z / 0.5;
        if (vectorAt(images[2], x, y).y < 0.9 || distance < 0) continue;
        if (distance < 1) sums[static_cast<size_t>(distance * 5)] += bent;
        if (distance < 1.2) continue;
        EXPECT_GT(bent.y, 0.99) << resolution << ' ' << x << ' ' << y;
      }
    }
    // At half resolution, pixels next to the wall take their direction from a pixel farther away.
    const double most = resolution == std::string("half") ? 3.5 : 3;
    for (size_t bin = 0; bin < 5; ++bin) {
      const double cosine =
          glm::dot(glm::normalize(sums[bin]), openOverFloor((static_cast<double>(bin) + 0.5) / 5));
      EXPECT_LT(glm::degrees(std::acos(std::min(cosine, 1.0))), most)
          << resolution << ", bin " << bin;
    }
  }
}

TEST_P(LightTest, BentNormalsOfSkyAreZeroAndChangeNothingElse) {
  const scene::Scene scene = tests::floorScene(4);
  const scene::Camera camera = {.eye = glm::dvec3(0, 1, 4), .target = glm::dvec3(0, 1, 0)};
  for (const char* estimator : {"slices", "classic"}) {
    AoFrames frames(device(), scene, {{"estimator", estimator}});
    const auto both = frames.showAll(camera, 64, 48, {"bent_normal", "ao"});
    EXPECT_EQ(vectorAt(both[0], 32, 2), glm::dvec3(0));
    EXPECT_EQ(both[1].pixels, frames.show(camera, 64, 48).pixels) << estimator;
  }
}

// The fit of Jimenez et al. 2016 for a visibility.
double bounced(double open, double albedo) {
  const double a = 2.0404 * albedo - 0.3324, b = -4.7951 * albedo + 0.6417;
  const double c = 2.7552 * albedo + 0.6903;
  return std::min(std::max(open, ((open * a + b) * open + c) * open), 1.0);
}

TEST_P(LightTest, BouncedLightFollowsTheFit) {
  const scene::Scene scene = tests::cornerScene();
  for (const Settings& estimator :
       std::vector<Settings>{{{"resolution", "half"}},
                             {{"resolution", "full"}},
                             {{"estimator", "classic"}},
                             {{"estimator", "classic"}, {"blur_size", "0"}}}) {
    AoFrames frames(device(), scene, estimator);
    const image::Image plain = frames.show(kCreaseView, 64, 48);
    for (const char* albedo : {"0", "0.3", "0.9", "1"}) {
      frames.set({{"bounce", "albedo"}, {"albedo", albedo}});
      const image::Image lit = frames.show(kCreaseView, 64, 48);
      for (size_t i = 0; i < plain.pixels.size(); ++i) {
        ASSERT_NEAR(lit.pixels[i], bounced(plain.pixels[i], std::stod(albedo)), 2e-3) << albedo;
      }
    }
  }
}

TEST_P(LightTest, BaseColoursTintTheComposedPictureAlone) {
  scene::Scene scene = tests::cornerScene();
  scene.materials[0].baseColor = glm::vec4(0.9f, 0.5f, 0.1f, 1);
  AoFrames frames(device(), scene, {{"bounce", "base_colour"}});
  const std::vector<std::string> outputs = {"ao", "tint", "base_colour", "color"};
  const auto images = frames.showAll(kCreaseView, 64, 48, outputs, frame::Surface::kBaseColour);
  // The compositor reads 8-bit sRGB, which GPUs may decode off by half a step: .0045.
  const double allowed = device().info().software ? 2e-3 : 5e-3;
  for (uint32_t y = 0; y < 48; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      for (uint32_t c = 0; c < 3; ++c) {
        const double tint = images[1].at(x, y, c), base = images[2].at(x, y, c);
        ASSERT_NEAR(tint, bounced(images[0].at(x, y), base), 2e-3);
        ASSERT_NEAR(images[3].at(x, y, c), tint * base, allowed);
      }
    }
  }
  // A white picture equals the visibility.
  const auto white = frames.showAll(kCreaseView, 64, 48, {"ao", "color"});
  for (uint32_t x = 0; x < 64; ++x) ASSERT_NEAR(white[1].at(x, 30, 2), white[0].at(x, 30), 1e-3);
  // Without the bounce, all channels are equal.
  frames.set({{"bounce", "none"}});
  const auto plain = frames.showAll(kCreaseView, 64, 48, {"ao", "tint"});
  for (uint32_t x = 0; x < 64; ++x) ASSERT_EQ(plain[1].at(x, 30, 2), plain[0].at(x, 30));
}

}  // namespace
}  // namespace grisaille
