// SPDX-License-Identifier: MIT
#include "lab/claims/screen_splats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace grisaille::lab::claims {
namespace {

image::Image coverage(float value) {
  return {.width = 256, .height = 256, .channels = 1, .pixels = std::vector<float>(65536, value)};
}

double meanOf(const image::Image& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / 65536;
}

TEST(ScreenSplats, NothingAndAllAreSo) {
  const ScreenSplats splats{.cell = 16, .sharpness = 0.9, .seed = 3};
  EXPECT_EQ(meanOf(screenSplats(coverage(0), splats)), 0);
  EXPECT_EQ(meanOf(screenSplats(coverage(1), splats)), 1);
}

TEST(ScreenSplats, MoreCoverageIsMorePaint) {
  const ScreenSplats splats{.cell = 16, .sharpness = 1, .seed = 3};
  double before = 0;
  for (const float value : {0.2f, 0.4f, 0.6f, 0.8f}) {
    const image::Image alpha = screenSplats(coverage(value), splats);
    EXPECT_TRUE(std::ranges::all_of(alpha.pixels, [](float a) { return a == 0 || a == 1; }));
    EXPECT_GT(meanOf(alpha), before + 0.03) << value;
    before = meanOf(alpha);
  }
  // The median of the noise is 0.45.
  EXPECT_NEAR(meanOf(screenSplats(coverage(0.45f), splats)), 0.5, 0.1);
}

TEST(ScreenSplats, TheCellIsTheirSize) {
  // Counts changes of paint along the rows; cells twice as large give half as many.
  const auto edges = [](double cell) {
    const image::Image alpha =
        screenSplats(coverage(0.45f), {.cell = cell, .sharpness = 1, .seed = 1});
    size_t count = 0;
    for (size_t i = 1; i < alpha.pixels.size(); ++i) {
      count += alpha.pixels[i] != alpha.pixels[i - 1] ? 1 : 0;
    }
    return static_cast<double>(count);
  };
  EXPECT_NEAR(edges(32) / edges(64), 2, 0.5);
}

}  // namespace
}  // namespace grisaille::lab::claims
