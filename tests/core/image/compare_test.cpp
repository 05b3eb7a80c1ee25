// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/image/image.h"
#include "tests/support/expect_error.h"

namespace grisaille::image {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image row(std::vector<float> values) {
  const auto width = static_cast<uint32_t>(values.size());
  return {.width = width, .height = 1, .channels = 1, .pixels = std::move(values)};
}

TEST(Compare, KnownNumbers) {
  const Difference d = compare(row({1, 2, 3, 4}), row({1, 3, 1, 4}));
  EXPECT_EQ(d.compared, 4u);
  EXPECT_EQ(d.nonFinite, 0u);
  EXPECT_DOUBLE_EQ(d.rmse, std::sqrt(5.0 / 4));
  EXPECT_DOUBLE_EQ(d.meanAbsolute, 3.0 / 4);
  EXPECT_DOUBLE_EQ(d.bias, 1.0 / 4);
  EXPECT_DOUBLE_EQ(d.largest, 2);
}

TEST(Compare, PercentileIsTheNearestRank) {
  std::vector<float> zeros(200, 0.0f), ramp(200);
  for (size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<float>(200 - i);
  EXPECT_DOUBLE_EQ(compare(row(ramp), row(zeros)).percentile99, 198);
  EXPECT_DOUBLE_EQ(compare(row({7}), row({0})).percentile99, 7);
}

TEST(Compare, SwappingTurnsOnlyTheBias) {
  const Image a = row({0.1f, 0.9f, 0.4f}), b = row({0.3f, 0.2f, 0.4f});
  const Difference ab = compare(a, b), ba = compare(b, a);
  EXPECT_DOUBLE_EQ(ab.rmse, ba.rmse);
  EXPECT_DOUBLE_EQ(ab.largest, ba.largest);
  EXPECT_DOUBLE_EQ(ab.bias, -ba.bias);
}

TEST(Compare, ValuesThatAreNotFiniteCountApart) {
  const Difference d = compare(row({kNan, 1, kInfinity, 2}), row({0, 1, kInfinity, 5}));
  EXPECT_EQ(d.nonFinite, 2u);
  EXPECT_EQ(d.compared, 2u);
  EXPECT_DOUBLE_EQ(d.largest, 3);
  EXPECT_EQ(compare(row({kNan}), row({kNan})).compared, 0u);
}

TEST(Compare, ShareOver) {
  EXPECT_DOUBLE_EQ(shareOver(row({0, 0, 0, 0}), row({0, 1, 2, 3}), 1.0), 0.5);
  EXPECT_DOUBLE_EQ(shareOver(row({kNan, kInfinity, kNan, -kInfinity}),
                             row({kNan, kInfinity, 0, kInfinity}), 1.0),
                   0.5);
}

TEST(Compare, OtherShapesAreRefused) {
  const Image a = row({1, 2});
  Image tall = a;
  std::swap(tall.width, tall.height);
  Image wide = a;
  wide.width = 1;
  wide.channels = 2;
  for (const Image& b : {tall, wide, row({1})}) {
    EXPECT_ERROR(ErrorId::kImageMismatch, compare(a, b));
    EXPECT_ERROR(ErrorId::kImageMismatch, shareOver(a, b, 0));
  }
}

}  // namespace
}  // namespace grisaille::image
