// SPDX-License-Identifier: MIT
// What the cases of the sweep begin with, and random combinations of all that it varies.
#pragma once

#include <string>
#include <vector>

#include "lab/stability/case.h"

namespace grisaille::lab::stability {

// An effect with values as the table calls them ("slices", "classic, raw", "paint", ...) before a
// scenery: its camera, its shots, and all lengths in proportion to its scale.
Case usualCase(const std::string& variant, const Scenery& scenery);

std::vector<Case> randomCases(uint32_t count, uint32_t seed);

// The edge of edges() that a case has, "" for most.
std::string edgeOf(const Case& one);

}  // namespace grisaille::lab::stability
