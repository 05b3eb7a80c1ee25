// SPDX-License-Identifier: MIT
// A shot as the table of objects lays it out.
#pragma once

#include <algorithm>
#include <cfloat>

namespace grisaille::sspm {

struct Shot {
  double origin[3];    // world, metres
  float direction[3];  // unit
  float color[3];      // linear, each 0 ... 1
  double range;        // metres; 0: the parameter paint_range

  // Metres, where the parameter is `otherwise`.
  float rangeOr(float otherwise) const {
    return range > 0 ? std::max(static_cast<float>(range), FLT_MIN) : otherwise;
  }
};

}  // namespace grisaille::sspm
