// SPDX-License-Identifier: MIT
// Creates the default cases that the sweep varies, and random combinations of everything it varies.
#pragma once

#include <string>
#include <vector>

#include "lab/stability/case.h"

namespace grisaille::lab::stability {

// The default case of a variant ("slices", "classic, raw", "paint", ...) in a scenery: its camera,
// its shots, and all lengths in proportion to the scenery's scale.
Case usualCase(const std::string& variant, const Scenery& scenery);

std::vector<Case> randomCases(uint32_t count, uint32_t seed);

// The key of the edge in edges() that applies to a case; "" for most cases.
std::string edgeOf(const Case& one);

}  // namespace grisaille::lab::stability
