// SPDX-License-Identifier: MIT
#include "core/shots/shot.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string_view>

#include "core/base/error.h"

namespace grisaille::shots {
namespace {

using Vector = std::array<double, 3>;

constexpr double kUnitTolerance = 0x1p-22;  // of the squared length; rounding to floats costs half

void requireFinite(const Vector& vector, ErrorId id, std::string_view name) {
  for (size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(vector[i])) {
      throw Error(id, "{}[{}] is {}, not finite", name, i, vector[i]);
    }
  }
}

void requireOrigin(const Vector& origin) {
  requireFinite(origin, ErrorId::kShotOrigin, "origin");
  for (size_t i = 0; i < 3; ++i) {
    if (std::abs(origin[i]) > kFarthestOrigin) {
      throw Error(ErrorId::kShotOrigin, "origin[{}] is {} m, beyond {} m", i, origin[i],
                  kFarthestOrigin);
    }
  }
}

void requireColor(const Vector& color) {
  for (size_t i = 0; i < 3; ++i) {
    if (!(color[i] >= 0 && color[i] <= 1)) {
      throw Error(ErrorId::kShotColor, "color[{}] is {}, out of 0 to 1", i, color[i]);
    }
  }
}

void requireRange(double range) {
  // A range that would round to a denormal float or to 0 would come to mean something else.
  if (range != 0 && !(range >= double{FLT_MIN} && range <= kLongestRange)) {
    throw Error(ErrorId::kShotRange, "range is {} m, neither 0 nor {} m to {} m", range,
                double{FLT_MIN}, kLongestRange);
  }
}

double squaredLength(const Vector& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

Vector unitOf(const Vector& direction) {
  requireFinite(direction, ErrorId::kShotDirection, "direction");
  if (std::abs(squaredLength(direction) - 1) <= kUnitTolerance) return direction;
  const double largest =
      std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
  if (largest == 0) throw Error(ErrorId::kShotDirection, "direction has no length");
  // Squares of very long or short components leave the range of a double; those of shares do not.
  const Vector share{direction[0] / largest, direction[1] / largest, direction[2] / largest};
  const double length = std::sqrt(squaredLength(share));
  return {share[0] / length, share[1] / length, share[2] / length};
}

ShotValues valuesOf(const grisaille_shot& shot) {
  return {.origin = {shot.origin[0], shot.origin[1], shot.origin[2]},
          .direction = {shot.direction[0], shot.direction[1], shot.direction[2]},
          .color = {shot.color[0], shot.color[1], shot.color[2]},
          .range = shot.range};
}

}  // namespace

grisaille_shot makeShot(const ShotValues& values) {
  requireOrigin(values.origin);
  requireColor(values.color);
  requireRange(values.range);
  const Vector unit = unitOf(values.direction);
  grisaille_shot shot{};
  for (size_t i = 0; i < 3; ++i) {
    shot.origin[i] = values.origin[i];
    shot.direction[i] = static_cast<float>(unit[i]);
    shot.color[i] = static_cast<float>(values.color[i]);
  }
  // A file leaves a range of 0 out: -0 would not come back.
  if (values.range != 0) shot.range = static_cast<float>(values.range);
  return shot;
}

void check(const grisaille_shot& shot) {
  makeShot(valuesOf(shot));
}

std::vector<grisaille_shot> checked(std::span<const grisaille_shot> shots) {
  std::vector<grisaille_shot> made;
  made.reserve(shots.size());
  for (const grisaille_shot& shot : shots) {
    try {
      made.push_back(makeShot(valuesOf(shot)));
    } catch (const Error& error) {
      throw Error(error.id(), "shots[{}].{}", made.size(), error.detail());
    }
  }
  return made;
}

}  // namespace grisaille::shots
