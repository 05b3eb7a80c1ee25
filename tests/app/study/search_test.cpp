// SPDX-License-Identifier: MIT
#include "app/study/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grisaille::app::study {
namespace {

constexpr const char* kKeys[] = {"box", "sharp", "round"};

grisaille_param_desc param(uint32_t type, double low, double high, bool log = false) {
  grisaille_param_desc desc{};
  desc.type = type;
  desc.flags = log ? GRISAILLE_PARAM_LOG : 0;
  desc.hard_min = desc.soft_min = low;
  desc.hard_max = desc.soft_max = high;
  if (type == GRISAILLE_PARAM_ENUM) {
    desc.enum_count = 3;
    desc.enum_keys = kKeys;
  }
  return desc;
}

// A synthetic effect that behaves like a real one. More samples cost proportionally more and err
// less; two values have an optimum; one of three modes errs less than the others; one parameter
// does nothing.
class Made : public testing::Test {
 protected:
  Made() {
    for (size_t i = 0; i < std::size(params_); ++i) {
      axes_.push_back({{.effect = "made", .key = std::to_string(i)}, &params_[i]});
    }
    oracle_ = {.error =
                   [this](const Point& p) {
                     ++errors_;
                     return errorOf(p);
                   },
               .cost = costOf,
               .costBeside =
                   [this](const Point& p, const Evaluated& known) {
                     ++costs_;
                     // A clock with an error of 1 % in either direction.
                     return known.cost * costOf(p) / costOf(known.point) *
                            (1 + (costs_ % 2 == 0 ? 0.01 : -0.01));
                   },
               .stop = [] { return false; }};
  }
  static double errorOf(const Point& p) {
    return 0.05 + 0.2 / std::sqrt(p[0]) + 0.1 * std::pow(std::log(p[1] / 0.7), 2) +
           0.04 * std::abs(p[2] - 1.3) + (p[3] == 1 ? 0 : 0.03);
  }
  static double costOf(const Point& p) { return 1 + p[0] / 8 + (p[3] == 1 ? 0.4 : 0); }

  grisaille_param_desc params_[5] = {
      param(GRISAILLE_PARAM_INT, 1, 256, true), param(GRISAILLE_PARAM_FLOAT, 0.01, 10, true),
      param(GRISAILLE_PARAM_FLOAT, 0, 4), param(GRISAILLE_PARAM_ENUM, 0, 2),
      param(GRISAILLE_PARAM_FLOAT, 0, 1)};
  std::vector<Axis> axes_;
  Oracle oracle_;
  int errors_ = 0, costs_ = 0;
};

TEST_F(Made, FindsTheCheapestUnderAnError) {
  std::mt19937 random(3);
  for (const double wish : {0.09, 0.1, 0.13, 0.18}) {
    for (int trial = 0; trial < 5; ++trial) {
      const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
      const Point start = {std::floor(2 + unit() * 60), 0.1 + unit() * 5, unit() * 4,
                           std::floor(unit() * 3), unit()};
      const Found found = search(axes_, {start}, {.maxError = wish}, oracle_, 200);
      ASSERT_TRUE(found.meetsWish);
      EXPECT_LE(errorOf(found.best.point), wish);
      // The lowest cost of any setting with all other parameters at their best.
      const double samples = std::ceil(std::pow(0.2 / (wish - 0.05), 2));
      EXPECT_LT(costOf(found.best.point), 1.25 * costOf({samples, 0, 0, 1, 0}))
          << wish << " from " << start[0] << " " << start[1];
    }
  }
}

TEST_F(Made, FindsTheMostAccurateInABudget) {
  for (const double budget : {2.0, 4.0, 9.0}) {
    const Found found = search(axes_, {{64, 2, 3, 0, 0.5}}, {.budget = budget}, oracle_, 200);
    ASSERT_TRUE(found.meetsWish);
    // The clock's errors add up over the steps.
    EXPECT_LE(costOf(found.best.point), 1.1 * budget);
    const double samples = std::floor((budget - 1.4) * 8);
    EXPECT_LT(errorOf(found.best.point), 0.015 + errorOf({samples, 0.7, 1.3, 1, 0}));
  }
}

TEST_F(Made, SaysWhenThereIsNoSuchSetting) {
  const Found found = search(axes_, {{16, 1, 1, 0, 0}}, {.maxError = 0.05}, oracle_, 300);
  EXPECT_FALSE(found.meetsWish);
  EXPECT_LT(found.best.error, 0.07);  // the smallest error that any setting reaches
  EXPECT_FALSE(search(axes_, {{16, 1, 1, 0, 0}}, {.budget = 0.5}, oracle_, 300).meetsWish);
}

TEST_F(Made, CountsWhatItAsksFor) {
  const std::vector<Point> starts = {{4, 1, 1, 0, 0}, {64, 1, 1, 0, 0}, {4, 1, 1, 0, 0}};
  for (const size_t most : {1u, 2u, 3u, 20u, 200u}) {
    errors_ = costs_ = 0;
    const Found found = search(axes_, starts, {.maxError = 0.1}, oracle_, most);
    EXPECT_LE(found.starts + found.steps, most);
    EXPECT_EQ(found.starts + found.steps, static_cast<size_t>(errors_));
    EXPECT_EQ(found.starts - 1 + found.steps - found.costsSaved, static_cast<size_t>(costs_));
    EXPECT_LE(found.starts, 2u);  // the same start is not tried twice
  }
  EXPECT_LT(errors_, 120);  // far below the 33^4 of a grid
  EXPECT_GT(search(axes_, starts, {.maxError = 0.1}, oracle_, 200).costsSaved, 10u);
}

// The first start is the setting that the user has: a result under the same error never costs more,
// whichever way the clock errs.
TEST_F(Made, NeverEndsDearerThanTheFirstStart) {
  std::mt19937 random(11);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int trial = 0; trial < 60; ++trial) {
    const Point first = {std::floor(2 + unit() * 60), 0.3 + unit(), unit() * 2,
                         std::floor(unit() * 3), unit()};
    const double wish = errorOf(first) * (trial % 3 == 0 ? 1 : 1 + 0.3 * unit());
    oracle_.costBeside = [&](const Point& p, const Evaluated& known) {
      return known.cost * costOf(p) / costOf(known.point) * (0.95 + 0.1 * unit());
    };
    const std::vector<Point> starts = {first, {256, 0.7, 1.3, 1, 0.5}, {64, 0.7, 1.3, 1, 0}};
    const size_t most = trial % 2 == 0 ? 200 : 1 + trial % 9;
    const Found found = search(axes_, starts, {.maxError = wish}, oracle_, most);
    ASSERT_TRUE(found.meetsWish);
    EXPECT_EQ(found.first.point, first);
    EXPECT_LE(found.best.cost, found.first.cost);
    EXPECT_LE(costOf(found.best.point), 1.06 * costOf(first));
    EXPECT_LE(errorOf(found.best.point), wish);
  }
}

TEST_F(Made, StopsWhenAsked) {
  oracle_.stop = [this] { return errors_ >= 7; };
  const Found found = search(axes_, {{16, 1, 1, 0, 0}}, {.maxError = 0.1}, oracle_, 200);
  EXPECT_TRUE(found.stopped);
  EXPECT_EQ(errors_, 7);
}

TEST_F(Made, StepsStayInTheRangeAndMove) {
  std::mt19937 random(8);
  for (const grisaille_param_desc& desc : params_) {
    for (int trial = 0; trial < 200; ++trial) {
      const double share = static_cast<double>(random()) / 4294967296.0;
      double value = desc.soft_min + share * (desc.soft_max - desc.soft_min);
      if (desc.type != GRISAILLE_PARAM_FLOAT) value = std::floor(value);
      for (const double step : {0.25, 0.03}) {
        for (const int direction : {-1, 1}) {
          const double next = stepped(desc, value, step, direction);
          EXPECT_GE(next, desc.soft_min);
          EXPECT_LE(next, desc.soft_max);
          if (desc.type != GRISAILLE_PARAM_FLOAT) {
            EXPECT_EQ(next, std::floor(next));
          }
          const bool atEnd = direction < 0 ? value == desc.soft_min : value == desc.soft_max;
          if (!atEnd) {
            EXPECT_NE(next, value) << desc.type;
          }
        }
      }
    }
  }
  // From outside the usual range, a step still moves.
  EXPECT_LT(stepped(params_[2], 9, 0.25, -1), 9);
}

}  // namespace
}  // namespace grisaille::app::study
