// SPDX-License-Identifier: MIT
// Tells which triangles lie inside matter that their own surface does not enclose. People build
// models of pieces that stick in each other: a foot in a floor, a relief in its panel. The far side
// of the foot is then not where matter ends.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace grisaille::trace {

// For each triangle of Scene::indices, whether it is buried in every instance. A triangle is buried
// if whoever stood on it would see only backs, in all directions, and most of them no farther away
// than a fifth of the scene's diagonal: under a sky that a sphere draws nothing is buried. One
// with a double-sided material must be so on both sides. Asks 16 places of a triangle, with 2 rays
// each. The same scene gives the same triangles. Throws what TracedScene throws; in builds without
// Embree, none are buried.
std::vector<bool> buriedTriangles(const scene::Scene& scene);

}  // namespace grisaille::trace
