// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/base/error.h"
#include "core/image/image.h"
#include "tests/support/expect_error.h"

namespace grisaille::image {
namespace {

constexpr double kC1 = 1e-4, kC2 = 9e-4;

Image flat(uint32_t width, uint32_t height, float value) {
  return {.width = width,
          .height = height,
          .channels = 1,
          .pixels = std::vector<float>(size_t{width} * height, value)};
}

Image greyNoise(uint32_t width, uint32_t height, unsigned seed) {
  Image image = flat(width, height, 0);
  std::mt19937 random(seed);
  for (float& pixel : image.pixels) pixel = static_cast<float>(random() % 1000) / 1000;
  return image;
}

TEST(Ssim, EqualPicturesHaveOne) {
  const Image image = greyNoise(40, 30, 1);
  const Similarity s = ssim(image, image);
  EXPECT_DOUBLE_EQ(s.mean, 1);
  EXPECT_EQ(s.windows, 30u * 20u);
  EXPECT_EQ(s.leftOut, 0u);
}

TEST(Ssim, ConstantPicturesCompareByTheirMeansAlone) {
  for (const float a : {0.0f, 0.25f, 1.0f}) {
    for (const float b : {0.0f, 0.5f, 1.0f}) {
      const double expected = (2.0 * a * b + kC1) / (double{a} * a + double{b} * b + kC1);
      EXPECT_NEAR(ssim(flat(16, 12, a), flat(16, 12, b)).mean, expected, 1e-9) << a << " " << b;
    }
  }
}

// One window with one pixel set, at its centre. That pixel has weight w = 0.2660124...^2, the
// square of 1 / (1 + 2 (e^(-2/9) + e^(-8/9) + e^-2 + e^(-32/9) + e^(-50/9))). Compared with black,
// the means are w and 0, the variances w - w^2 and 0, the covariance 0.
TEST(Ssim, ASinglePixelByHand) {
  Image dot = flat(11, 11, 0);
  dot.pixels[5 * 11 + 5] = 1;
  const double w = 0.26601172 * 0.26601172;
  const double expected = kC1 * kC2 / ((w * w + kC1) * (w - w * w + kC2));
  const Similarity s = ssim(dot, flat(11, 11, 0));
  EXPECT_EQ(s.windows, 1u);
  EXPECT_NEAR(s.mean, expected, 1e-6 * expected);
}

// SSIM computed from its definition, window by window.
TEST(Ssim, TwoNoisesByTheDefinition) {
  const Image a = greyNoise(13, 12, 2), b = greyNoise(13, 12, 3);
  double weights[11], sum = 0, mean = 0;
  for (int i = 0; i < 11; ++i) sum += weights[i] = std::exp(-(i - 5) * (i - 5) / (2 * 1.5 * 1.5));
  for (uint32_t top = 0; top < 2; ++top) {
    for (uint32_t left = 0; left < 3; ++left) {
      const auto over = [&](const auto& value) {
        double total = 0;
        for (uint32_t y = 0; y < 11; ++y) {
          for (uint32_t x = 0; x < 11; ++x) {
            total += weights[x] * weights[y] / (sum * sum) *
                     value(double{a.at(left + x, top + y)}, double{b.at(left + x, top + y)});
          }
        }
        return total;
      };
      const double ma = over([](double x, double) { return x; });
      const double mb = over([](double, double y) { return y; });
      const double va = over([&](double x, double) { return (x - ma) * (x - ma); });
      const double vb = over([&](double, double y) { return (y - mb) * (y - mb); });
      const double vab = over([&](double x, double y) { return (x - ma) * (y - mb); });
      mean +=
          (2 * ma * mb + kC1) * (2 * vab + kC2) / ((ma * ma + mb * mb + kC1) * (va + vb + kC2)) / 6;
    }
  }
  EXPECT_NEAR(ssim(a, b).mean, mean, 1e-9);
  EXPECT_DOUBLE_EQ(ssim(a, b).mean, ssim(b, a).mean);
}

TEST(Ssim, WindowsWithAPixelThatIsNotFiniteAreLeftOut) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const Image a = greyNoise(30, 11, 4);
    Image b = a;
    b.pixels[5 * 30] = bad;  // the leftmost column is in one window
    EXPECT_EQ(ssim(a, b).leftOut, 1u);
    EXPECT_EQ(ssim(b, a).windows, 19u);
    EXPECT_DOUBLE_EQ(ssim(a, b).mean, 1);
    b.pixels[5 * 30 + 15] = bad;  // this column is in eleven more
    EXPECT_EQ(ssim(a, b).leftOut, 12u);
  }
}

TEST(Ssim, PicturesSmallerThanTheWindowHaveNone) {
  EXPECT_EQ(ssim(flat(10, 40, 0), flat(10, 40, 1)).windows, 0u);
  EXPECT_EQ(ssim(flat(40, 10, 0), flat(40, 10, 1)).windows, 0u);
}

TEST(Ssim, OtherShapesAreRefused) {
  Image colour = flat(12, 12, 0);
  colour.channels = 3;
  colour.pixels.resize(12 * 12 * 3);
  EXPECT_ERROR(ErrorId::kImageMismatch, ssim(flat(12, 12, 0), flat(12, 13, 0)));
  EXPECT_ERROR(ErrorId::kImageMismatch, ssim(colour, colour));
}

}  // namespace
}  // namespace grisaille::image
