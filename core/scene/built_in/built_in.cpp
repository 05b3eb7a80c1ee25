// SPDX-License-Identifier: MIT
#include "core/scene/built_in.h"

#include <algorithm>

#include "core/scene/built_in/scenes.h"

namespace grisaille::scene {
namespace {

constexpr BuiltIn kBuiltIns[] = {
    {"atrium", "an atrium with columns, arches, vases, cloths and plants", makeAtrium, 0.5},
    {"leaves", "a garden with trees, a hedge, grass and a fence", makeLeaves, 0.4},
    {"grating", "a walkway of steel bars with handrails, machines, pipes and cables", makeGrating,
     0.1},
    {"street", "a street of town houses with cars, lamps, awnings and cables", makeStreet, 1},
    {"table", "a dining room with a laid table, chairs, a bookcase and curtains", makeTable, 0.3},
    {"carving", "a carved board with chessmen, a chain, rings and a comb", makeCarving, 0.02},
};

}  // namespace

std::span<const BuiltIn> builtIns() {
  return kBuiltIns;
}

const BuiltIn* findBuiltIn(std::string_view name) {
  if (name.empty()) return &kBuiltIns[0];
  const auto found = std::ranges::find(kBuiltIns, name, &BuiltIn::name);
  return found == std::end(kBuiltIns) ? nullptr : found;
}

std::string builtInNames() {
  std::string names;
  for (const BuiltIn& one : kBuiltIns) names += (names.empty() ? "" : ", ") + std::string(one.name);
  return names;
}

}  // namespace grisaille::scene
