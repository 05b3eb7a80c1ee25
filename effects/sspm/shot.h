// SPDX-License-Identifier: MIT
// A shot, with the layout of the table of objects (kShots in parameters.h).
#pragma once

#include <algorithm>
#include <cfloat>
#include <cstdint>

namespace grisaille::sspm {

struct Shot {
  double origin[3];    // world, metres
  float direction[3];  // unit
  float color[3];      // linear, each 0 ... 1
  double range;        // metres; 0: use the parameter paint_range

  // The shot's range, metres. otherwise: value of the parameter, metres.
  float rangeOr(float otherwise) const {
    return range > 0 ? std::max(static_cast<float>(range), FLT_MIN) : otherwise;
  }
};

// Twins have one ray and one range. Only the newest of them is drawn, and stands for all.
bool areTwins(const Shot& a, const Shot& b);
// The same for twins.
uint64_t twinHash(const Shot& shot);

// The seed of a shot's splat; shaders/sspm/splat.glsl computes the same.
// noiseSeed: the parameter.
uint32_t splatSeed(const Shot& shot, uint32_t noiseSeed);

}  // namespace grisaille::sspm
