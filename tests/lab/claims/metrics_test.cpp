// SPDX-License-Identifier: MIT
// Metrics of pictures with known values.
#include "lab/claims/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace grisaille::lab::claims {
namespace {

constexpr uint32_t kWidth = 32, kHeight = 24;

using Value = std::function<double(uint32_t x, uint32_t y)>;

image::Image picture(const Value& value) {
  image::Image image{.width = kWidth, .height = kHeight, .channels = 1, .pixels = {}};
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    image.pixels.push_back(static_cast<float>(value(i % kWidth, i / kWidth)));
  }
  return image;
}

double plain(uint32_t, uint32_t) {
  return 0.5;
}

bool everywhere(uint32_t, uint32_t) {
  return true;
}

// The metric of one frame.
double of(const char* metric, const Value& shown, const Value& reference,
          const std::function<bool(uint32_t, uint32_t)>& inside = everywhere) {
  std::vector<trace::FlickerFrame> frames(1);
  const std::vector<image::Image> a = {picture(shown)}, b = {picture(reference)};
  std::vector<std::vector<uint8_t>> region(1);
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    region[0].push_back(inside(i % kWidth, i / kWidth) ? 1 : 0);
  }
  return measured(metric, {.frames = frames, .shown = a, .reference = b, .region = region});
}

bool left(uint32_t x, uint32_t) {
  return x < kWidth / 2;
}

TEST(Metrics, MeansAndErrorsAreOverTheRegion) {
  const auto steps = [](uint32_t x, uint32_t) { return x < kWidth / 2 ? 0.75 : 0.25; };
  EXPECT_NEAR(of("mean", steps, plain), 0.5, 1e-6);
  EXPECT_NEAR(of("mean", steps, plain, left), 0.75, 1e-6);
  EXPECT_NEAR(of("bias", steps, plain), 0, 1e-6);
  EXPECT_NEAR(of("bias", steps, plain, left), 0.25, 1e-6);
  EXPECT_NEAR(of("rmse", steps, plain), 0.25, 1e-6);
  EXPECT_TRUE(std::isnan(of("rmse", steps, plain, [](uint32_t, uint32_t) { return false; })));
}

// A pattern with a period of 4 pixels is pure noise, a broad one pure banding.
TEST(Metrics, NoiseAndBandsPartTheError) {
  const auto pattern = [](uint32_t x, uint32_t y) {
    return 0.5 + 0.1 * ((x + 2 * y) % 4 < 2 ? 1 : -1);
  };
  EXPECT_NEAR(of("noise", pattern, plain), 0.1, 1e-6);
  EXPECT_NEAR(of("bands", pattern, plain), 0, 1e-6);
  const auto broad = [](uint32_t, uint32_t) { return 0.7; };
  EXPECT_NEAR(of("noise", broad, plain), 0, 1e-6);
  EXPECT_NEAR(of("bands", broad, plain), 0.2, 1e-6);
  const auto both = [&](uint32_t x, uint32_t y) { return pattern(x, y) + 0.2; };
  EXPECT_NEAR(of("noise", both, plain), 0.1, 1e-6);
  EXPECT_NEAR(of("bands", both, plain), 0.2, 1e-6);
  // Squares that reach out of the region are left out.
  const auto bad = [&](uint32_t x, uint32_t y) { return left(x, y) ? pattern(x, y) : 9.0; };
  EXPECT_NEAR(of("noise", bad, plain, left), 0.1, 1e-6);
  EXPECT_TRUE(
      std::isnan(of("noise", broad, plain, [](uint32_t x, uint32_t) { return x % 4 != 0; })));
}

TEST(Metrics, PaintBesideTheMaskIsCountedBeyondItsMargin) {
  const auto mask = [](uint32_t x, uint32_t) { return x < 8 ? 1.0 : 0.0; };
  const auto upTo = [](uint32_t end) {
    return [end](uint32_t x, uint32_t) { return x < end ? 1.0 : 0.0; };
  };
  EXPECT_EQ(of("mask_outside", upTo(8), mask), 0);
  EXPECT_EQ(of("mask_outside", upTo(10), mask), 0);  // two pixels are tolerated
  EXPECT_NEAR(of("mask_outside", upTo(20), mask), 0.5, 1e-9);
  EXPECT_TRUE(std::isnan(of("mask_outside", upTo(0), mask)));
}

TEST(Metrics, EachIsThereOnce) {
  for (const MetricInfo& metric : metrics()) EXPECT_EQ(findMetric(metric.key), &metric);
  EXPECT_EQ(findMetric("none"), nullptr);
}

}  // namespace
}  // namespace grisaille::lab::claims
