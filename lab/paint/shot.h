// SPDX-License-Identifier: MIT
// Shots of the effect `sspm`: the fields of its table of objects.
#pragma once

#include <algorithm>
#include <cfloat>
#include <span>
#include <string>
#include <vector>

#include "core/effect/registry.h"
#include "core/objects/object.h"

namespace grisaille::lab {

struct Shot {
  double origin[3];    // world, metres
  float direction[3];  // unit
  float color[3];      // linear, each 0 ... 1
  double range;        // metres; 0: the value of the parameter paint_range

  // The range in metres; `otherwise` is the value of paint_range.
  float rangeOr(float otherwise) const {
    return range > 0 ? std::max(static_cast<float>(range), FLT_MIN) : otherwise;
  }
};

// The table of sspm's objects. Throws kEffectUnknown.
const objects::Table& shotTable(const effect::Registry& registry);

std::vector<Shot> shotsOf(const objects::View& objects);

// Converts shots to the objects that a chain takes. Throws kObjectField for an invalid field.
objects::Objects objectsOf(const objects::Table& table, std::span<const Shot> shots);

// Throws what objects::load() throws.
std::vector<Shot> loadShots(const effect::Registry& registry, const std::string& path);

}  // namespace grisaille::lab
