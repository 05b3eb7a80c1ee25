// SPDX-License-Identifier: MIT
// A shot, with the layout of the table of objects (kShots in parameters.h).
#pragma once

#include <algorithm>
#include <cfloat>
#include <cstdint>
#include <span>
#include <vector>

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

// A shot as it is composited.
struct Layer {
  size_t shot = 0;  // index into the list
  float times = 1;  // number of twins that it stands for, itself included
};
// The newest `count` shots of a list, newest first, without those that a newer twin stands for.
std::vector<Layer> layersOf(std::span<const Shot> shots, size_t count);

}  // namespace grisaille::sspm
