// SPDX-License-Identifier: MIT
#include "core/shots/shot.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <limits>
#include <random>

#include "tests/core/shots/random_shots.h"
#include "tests/support/expect_error.h"

namespace grisaille::shots {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

ShotValues sound() {
  return {.origin = {1, 2, 3}, .direction = {0, 0, -1}, .color = {1, 0.5, 0}, .range = 0.25};
}

TEST(Shot, EachFieldIsRefusedByName) {
  for (size_t i = 0; i < 3; ++i) {
    for (const double bad : {kNan, kInfinity, -kInfinity, 1.0000001e9, -1e300}) {
      ShotValues values = sound();
      values.origin[i] = bad;
      EXPECT_ERROR(ErrorId::kShotOrigin, makeShot(values));
    }
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      ShotValues values = sound();
      values.direction[i] = bad;
      EXPECT_ERROR(ErrorId::kShotDirection, makeShot(values));
    }
    for (const double bad : {kNan, kInfinity, -kInfinity, -1e-9, 1.000000001, -DBL_MIN}) {
      ShotValues values = sound();
      values.color[i] = bad;
      EXPECT_ERROR(ErrorId::kShotColor, makeShot(values));
    }
  }
  for (const double bad : {kNan, kInfinity, -kInfinity, -1.0, 1e-40, 1e-300, 1.0000001e6}) {
    ShotValues values = sound();
    values.range = bad;
    EXPECT_ERROR(ErrorId::kShotRange, makeShot(values));
  }
  ShotValues values = sound();
  values.direction = {0, -0.0, 0};
  EXPECT_ERROR(ErrorId::kShotDirection, makeShot(values));
}

TEST(Shot, LimitsBelong) {
  ShotValues values = sound();
  values.origin = {kFarthestOrigin, -kFarthestOrigin, -0.0};
  values.color = {0, 1, -0.0};
  for (const double range : {0.0, -0.0, double{FLT_MIN}, kLongestRange}) {
    values.range = range;
    const grisaille_shot shot = makeShot(values);
    EXPECT_EQ(shot.range, static_cast<float>(range));
    EXPECT_FALSE(std::signbit(shot.range));
    check(shot);
  }
}

TEST(Shot, DirectionsOfAnyLengthComeOutUnit) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double length :
       {5e-324, 1e-320, 1e-300, 1e-160, 1e-20, 1.0, 1e20, 1e160, 1e300, 1.79e308}) {
    // Along an axis even the shortest double has a direction.
    for (size_t axis = 0; axis < 3; ++axis) {
      ShotValues values = sound();
      values.direction = {};
      values.direction[axis] = -length;
      EXPECT_EQ(makeShot(values).direction[axis], -1.0f) << length;
    }
    if (length < 1e-300) continue;  // a denormal is too coarse for more than that
    for (int i = 0; i < 1000; ++i) {
      std::array<double, 3> unit{normal(random), normal(random), normal(random)};
      const double size = std::hypot(unit[0], unit[1], unit[2]);
      ShotValues values = sound();
      for (size_t k = 0; k < 3; ++k) {
        unit[k] /= size;
        values.direction[k] = unit[k] * length;
      }
      const grisaille_shot shot = makeShot(values);
      for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(shot.direction[k], unit[k], 1e-7) << length;
    }
  }
}

TEST(Shot, MakingAShotOfAShotChangesNothing) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    const grisaille_shot shot = randomShot(random);
    const std::vector<grisaille_shot> again = checked(std::span(&shot, 1));
    ASSERT_TRUE(sameShot(shot, again[0])) << i;
  }
}

TEST(Shot, FloatsAreCheckedAsTheyAre) {
  grisaille_shot shot = makeShot(sound());
  check(shot);
  shot.direction[2] = std::numeric_limits<float>::denorm_min();
  shot.reserved = 7;
  const grisaille_shot made = checked(std::span(&shot, 1))[0];
  EXPECT_EQ(made.direction[2], 1.0f);
  EXPECT_EQ(made.reserved, 0u);
  shot.range = std::numeric_limits<float>::denorm_min();
  EXPECT_ERROR(ErrorId::kShotRange, check(shot));
}

}  // namespace
}  // namespace grisaille::shots
