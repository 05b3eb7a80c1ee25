// SPDX-License-Identifier: MIT
// Sound shots by chance, and what it takes to compare them bit by bit.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "core/shots/shot.h"

namespace grisaille::shots {

// Numbers of every size up to `largest`, of either sign, and now and then 0 or -0.
inline double anySize(std::mt19937_64& random, double largest) {
  std::uniform_real_distribution<double> share(-1, 1);
  const double value = largest * share(random);
  switch (random() % 8) {
    case 0:
      return std::copysign(0.0, value);
    case 1:
      return std::copysign(largest, value);
    case 2:
      return value;
    default:
      return value * std::exp2(-std::abs(share(random)) * 120);
  }
}

inline grisaille_shot randomShot(std::mt19937_64& random) {
  ShotValues values;
  for (double& value : values.origin) value = anySize(random, kFarthestOrigin);
  for (double& value : values.direction) value = anySize(random, 1e300);
  values.direction[random() % 3] = anySize(random, 1) + 3;
  for (double& value : values.color) value = std::abs(anySize(random, 1));
  values.range = random() % 2 ? 0 : std::abs(anySize(random, kLongestRange));
  return makeShot(values);
}

inline std::vector<grisaille_shot> randomShots(std::mt19937_64& random, size_t count) {
  std::vector<grisaille_shot> shots(count);
  for (grisaille_shot& shot : shots) shot = randomShot(random);
  return shots;
}

static_assert(sizeof(grisaille_shot) == 56, "a shot has no padding, so that its bytes tell all");
using ShotBits = std::array<uint64_t, 7>;

inline bool sameShot(const grisaille_shot& a, const grisaille_shot& b) {
  return std::bit_cast<ShotBits>(a) == std::bit_cast<ShotBits>(b);
}

inline bool sameShots(std::span<const grisaille_shot> a, std::span<const grisaille_shot> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), sameShot);
}

}  // namespace grisaille::shots
