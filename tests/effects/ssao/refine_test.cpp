// SPDX-License-Identifier: MIT
// The parameter `refine`: pixels at full resolution where the effect's is lower.
#include <gtest/gtest.h>

#include "core/image/image.h"
#include "tests/effects/ssao/render_ao.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

constexpr uint32_t kWide = 240, kTall = 180;
const scene::Camera kBarsView = {.eye = glm::dvec3(0.4, 0.8, 2.2), .target = glm::dvec3(0, 0.4, 0)};

class RefineTest : public tests::BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(RefineTest);

// Bars a few pixels wide and as far apart, on a floor and before a wall: a texel of 2x2 or 4x4
// pixels rarely lies on the same surface as the next.
scene::Scene barsScene() {
  scene::Scene scene = tests::cornerScene();
  for (int i = -12; i <= 12; ++i) {
    const float x = 0.09f * static_cast<float>(i) + 0.02f * static_cast<float>(i % 3);
    tests::addQuad(scene,
                   {glm::vec3(x - 0.015f, 0, 0.2f),
                    {x + 0.015f, 0, 0.2f},
                    {x + 0.015f, 0.9f, 0.2f},
                    {x - 0.015f, 0.9f, 0.2f}},
                   {0, 0, 1});
  }
  return scene;
}

double errorOf(const image::Image& one, const image::Image& other) {
  return image::compare(one, other).rmse;
}

TEST_P(RefineTest, BringsThePictureNearerToManySlicesAtFullResolution) {
  const scene::Scene scene = barsScene();
  const std::vector<std::string> outputs = {"ao", "bent_normal"};
  const auto rendered = [&](tests::Settings settings) {
    settings.emplace_back("backs", "drawn");
    return tests::AoFrames(device(), scene, settings).showAll(kBarsView, kWide, kTall, outputs);
  };
  const std::vector<image::Image> best = rendered(
      {{"resolution", "full"}, {"blur_size", "0"}, {"slices", "32"}, {"kernel_size", "768"}});
  for (const char* resolution : {"half", "quarter"}) {
    const auto refined = [&](const char* refine) {
      // Enough slices that little noise is left: what remains is what the upsampling loses.
      return rendered({{"resolution", resolution},
                       {"slices", "4"},
                       {"kernel_size", "96"},
                       {"refine", refine},
                       {"contrast", "0.1"},
                       {"edge_slices", "2"}});
    };
    const std::vector<image::Image> plain = refined("nothing"), edges = refined("edges"),
                                    contrasts = refined("contrasts");
    for (size_t i = 0; i < outputs.size(); ++i) {
      const double without = errorOf(plain[i], best[i]);
      EXPECT_LT(errorOf(edges[i], best[i]), without) << resolution << ' ' << outputs[i];
      EXPECT_LT(errorOf(contrasts[i], best[i]), 0.83 * without) << resolution << ' ' << outputs[i];
    }
  }
}

TEST_P(RefineTest, ChangesNothingInAPlaneNorAtFullResolution) {
  const auto rendered = [&](const scene::Scene& scene, const char* resolution, const char* refine) {
    return tests::renderAo(device(), scene, kBarsView,
                           {{"resolution", resolution}, {"refine", refine}});
  };
  const scene::Scene bars = barsScene(), wall = tests::wallScene();
  for (const char* refine : {"edges", "contrasts"}) {
    EXPECT_EQ(rendered(bars, "full", "nothing").pixels, rendered(bars, "full", refine).pixels);
    for (const char* resolution : {"half", "quarter"}) {
      const image::Image plain = rendered(wall, resolution, "nothing");
      const image::Image refined = rendered(wall, resolution, refine);
      // The last row and column of texels lie before the border: pixels behind them have texels on
      // one side only, and are refined.
      for (uint32_t y = 0; y + 4 < plain.height; ++y) {
        for (uint32_t x = 0; x + 4 < plain.width; ++x) {
          ASSERT_EQ(plain.at(x, y), refined.at(x, y)) << resolution << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST_P(RefineTest, GivesTheSameBitsEachTimeAndAtOddSizes) {
  const scene::Scene scene = barsScene();
  for (const char* resolution : {"half", "quarter"}) {
    const tests::Settings settings = {{"resolution", resolution}, {"refine", "contrasts"}};
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {1u, 64u}, {3u, 3u}, {65u, 2u}, {257u, 129u}}) {
      const image::Image first =
          tests::renderAo(device(), scene, kBarsView, settings, width, height);
      tests::expectVisibility(first, fmt::format("{} {}x{}", resolution, width, height));
      EXPECT_EQ(first.pixels,
                tests::renderAo(device(), scene, kBarsView, settings, width, height).pixels)
          << resolution << ' ' << width << 'x' << height;
    }
  }
}

// The list holds what one frame needs: a smaller picture, a larger one, none, and it again.
TEST_P(RefineTest, FramesOfOtherSizesLeaveNothingBehind) {
  const scene::Scene scene = barsScene();
  const tests::Settings settings = {{"resolution", "quarter"}, {"refine", "contrasts"}};
  tests::AoFrames frames(device(), scene, settings);
  for (const uint32_t width : {64u, 240u, 31u, 240u}) {
    EXPECT_EQ(frames.show(kBarsView, width, 60).pixels,
              tests::renderAo(device(), scene, kBarsView, settings, width, 60).pixels)
        << width;
  }
  frames.set({{"refine", "nothing"}});
  frames.show(kBarsView, 64, 60);
  frames.set({{"refine", "contrasts"}});
  EXPECT_EQ(frames.show(kBarsView, 64, 60).pixels,
            tests::renderAo(device(), scene, kBarsView, settings, 64, 60).pixels);
}

// Where a history averages frames, the refined pixels draw the same points in each: they rest.
TEST_P(RefineTest, RefinedPixelsRestWhileAHistoryAverages) {
  const scene::Scene scene = barsScene();
  tests::AoFrames frames(device(), scene,
                         {{"resolution", "quarter"}, {"refine", "contrasts"}, {"history", "16"}});
  tests::AoFrames plain(device(), scene, {{"resolution", "quarter"}, {"history", "16"}});
  for (int i = 0; i < 20; ++i) {
    frames.show(kBarsView, kWide, kTall);
    plain.show(kBarsView, kWide, kTall);
  }
  const double flicker =
      errorOf(frames.show(kBarsView, kWide, kTall), frames.show(kBarsView, kWide, kTall));
  const double usual =
      errorOf(plain.show(kBarsView, kWide, kTall), plain.show(kBarsView, kWide, kTall));
  EXPECT_LT(flicker, 1.2 * usual);
}

TEST(RefineBackends, Agree) {
  const std::vector<tests::TestDevice> backends = tests::presentSystemDevices();
  if (backends.size() < 2) GTEST_SKIP() << "only one backend is present";
  for (const char* resolution : {"half", "quarter"}) {
    const tests::Settings settings = {{"resolution", resolution}, {"refine", "contrasts"}};
    std::vector<image::Image> images;
    for (const tests::TestDevice& backend : backends) {
      const auto device = tests::openDevice(backend);
      images.push_back(tests::renderAo(*device, barsScene(), kBarsView, settings, kWide, kTall));
    }
    EXPECT_LT(image::shareOver(images[0], images[1], 2.0 / 255), 0.001) << resolution;
  }
}

}  // namespace
}  // namespace grisaille
