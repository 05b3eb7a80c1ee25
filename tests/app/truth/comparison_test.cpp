// SPDX-License-Identifier: MIT
// Error figures against a truth that is still being traced.
#include "app/truth/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "app/truth/error_map.h"
#include "app/truth/pixel_order.h"

namespace grisaille::app::truth {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(PixelOrder, EveryPixelOnceAndOneOfEachSquareFirst) {
  for (const glm::uvec2 size : {glm::uvec2(1), {1, 9}, {3, 5}, {17, 9}, {64, 48}, {130, 67}}) {
    SCOPED_TRACE(testing::Message() << size.x << "x" << size.y);
    const std::vector<uint32_t> order = pixelOrder(size);
    const auto count = size_t{size.x} * size.y;
    ASSERT_EQ(order.size(), count);
    std::vector<bool> seen(count);
    const auto isTraced = [&](uint32_t index) { return seen[index]; };
    for (const uint32_t side : {4u, 2u}) {
      const glm::uvec2 squares = (size + side - 1u) / side;
      seen.assign(count, false);
      std::vector<int> taken(size_t{squares.x} * squares.y);
      for (size_t i = 0; i < taken.size(); ++i) {
        seen[order[i]] = true;
        const glm::uvec2 square = glm::uvec2(order[i] % size.x, order[i] / size.x) / side;
        ++taken[square.y * squares.x + square.x];
      }
      for (const int one : taken) EXPECT_EQ(one, 1);
      for (uint32_t i = 0; i < count; ++i) {
        const glm::uvec2 pixel(i % size.x, i / size.x);
        const uint32_t other = standIn(pixel, size, isTraced);
        ASSERT_NE(other, UINT32_MAX);
        EXPECT_EQ(glm::uvec2(other % size.x, other / size.x) / side, pixel / side);
      }
    }
    seen.assign(count, false);
    EXPECT_EQ(standIn({0, 0}, size, isTraced), UINT32_MAX);
    for (const uint32_t index : order) seen[index] = true;
    EXPECT_EQ(std::ranges::count(seen, true), static_cast<std::ptrdiff_t>(count));
  }
}

TEST(PixelOrder, ThePlaceInASquareIsChance) {
  const glm::uvec2 size(256, 256);
  const std::vector<uint32_t> order = pixelOrder(size);
  constexpr size_t kSquares = 64 * 64;
  std::array<int, 16> places{};
  for (size_t i = 0; i < kSquares; ++i) {
    ++places[(order[i] / size.x % 4) * 4 + order[i] % 4];
  }
  for (const int count : places) EXPECT_NEAR(count, kSquares / 16.0, 5 * std::sqrt(kSquares / 16));
}

TEST(PixelOrder, EveryRunIsSpreadOverThePicture) {
  const glm::uvec2 size(320, 200);
  const std::vector<uint32_t> order = pixelOrder(size);
  for (size_t first = 0; first + 1000 <= order.size(); first += 1000) {
    double x = 0, y = 0;
    for (size_t i = first; i < first + 1000; ++i) {
      x += order[i] % size.x;
      y += order[i] / size.x;
    }
    EXPECT_NEAR(x / 1000, 160, 20) << first;
    EXPECT_NEAR(y / 1000, 100, 20) << first;
  }
}

TEST(ErrorMap, TellsDarkFromBright) {
  EXPECT_EQ(errorColor(0), glm::vec3(1));
  const glm::vec3 dark = errorColor(-kFullError), bright = errorColor(kFullError);
  EXPECT_GT(dark.b, dark.r);
  EXPECT_GT(bright.r, bright.b);
  EXPECT_EQ(errorColor(-1), dark);
  EXPECT_EQ(errorColor(1), bright);
  EXPECT_EQ(errorColor(kNan), glm::vec3(0.5f));
}

// A picture with errors, its noise-free truth, and the noise of each pixel.
struct Subject {
  image::Image shown{.width = 120, .height = 90, .channels = 1, .pixels = {}};
  std::vector<float> truth, noise;
  double rmse = 0, bias = 0;

  explicit Subject(double error) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    for (uint32_t i = 0; i < shown.width * shown.height; ++i) {
      truth.push_back(unit(random));
      noise.push_back(0.1f * unit(random));
      const auto off = static_cast<float>(error * (unit(random) + 0.3 * std::sin(i * 0.01)));
      shown.pixels.push_back(truth.back() + off);
      const double d = double{shown.pixels.back()} - double{truth.back()};
      rmse += d * d;
      bias += d;
    }
    rmse = std::sqrt(rmse / static_cast<double>(truth.size()));
    bias /= static_cast<double>(truth.size());
  }
};

TEST(Comparison, OfAWholeTruthIsThatOfPictures) {
  const Subject subject(0.2);
  std::vector<trace::Visibility> truth;
  for (const float value : subject.truth) truth.push_back({value, 0});
  truth[5].mean = kNan;  // as where all rays go below the facet
  image::Image other = subject.shown;
  for (size_t i = 0; i < truth.size(); ++i) other.pixels[i] = truth[i].mean;
  const image::Difference expected = image::compare(subject.shown, other);
  const Comparison found = compare(subject.shown, truth);
  EXPECT_EQ(found.pixels, expected.compared);
  EXPECT_NEAR(found.rmse, expected.rmse, 1e-9);
  EXPECT_NEAR(found.bias, expected.bias, 1e-9);
  EXPECT_EQ(found.noise, 0);
  EXPECT_LT(found.error, 1e-3);
  truth.assign(truth.size(), {0, kUntraced});
  EXPECT_EQ(compare(subject.shown, truth).pixels, 0u);
}

// Repeated comparisons with part of the pixels and a noisy truth: correct on average, with errors
// as large as stated.
TEST(Comparison, OfANoisyPartIsUnbiasedAndHonest) {
  for (const double size : {0.02, 0.2}) {
    const Subject subject(size);
    for (const double share : {0.05, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << size << ", " << share << " of the pixels");
      constexpr int kTrials = 300;
      double sum = 0, plain = 0, squares = 0;
      for (int trial = 0; trial < kTrials; ++trial) {
        std::mt19937 random(static_cast<unsigned>(trial));
        std::normal_distribution<float> normal;
        std::uniform_real_distribution<double> unit(0, 1);
        std::vector<trace::Visibility> truth;
        for (size_t i = 0; i < subject.truth.size(); ++i) {
          const float s = subject.noise[i];
          const float mean = subject.truth[i] + s * normal(random);
          truth.push_back({mean, unit(random) < share ? s : kUntraced});
        }
        const Comparison found = compare(subject.shown, truth);
        sum += found.rmse * found.rmse;
        plain += found.rmse * found.rmse + found.noise * found.noise;
        const double off = (found.rmse - subject.rmse) / found.error;
        squares += off * off;
      }
      const double exact = subject.rmse * subject.rmse;
      // The remaining bias is a small share of the bias that the noise would add.
      EXPECT_NEAR(sum / kTrials, exact, 0.03 * (plain - sum) / kTrials);
      EXPECT_LT(std::sqrt(squares / kTrials), 1.3);
      EXPECT_GT(std::sqrt(squares / kTrials), 0.4);
    }
  }
}

}  // namespace
}  // namespace grisaille::app::truth
