// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grisaille::tests {

// A .glb file: a floor that stands still, a box that animations move, a skinned arm, and a box with
// a morph target. All stand within 3 m of the origin, on the plane y = 0. Four animations:
//
//   0, "move", 2 s: linear and cubic keys of the box's place, the arm's joint and the morph target
//   1, "jump", 1 s: step keys of the same
//   2, without a name, 0.5 s: the scale of the box
//   3, "high", 1 s: the box rises by 12 m
//
// slowness: factor for the times of all keys, above 0. Cubic tangents keep their values.
std::string animatedGlb(float slowness = 1);

}  // namespace grisaille::tests
