// SPDX-License-Identifier: MIT
// Puts a floor under a scene that has none, so that it has something to occlude.
#pragma once

#include "core/scene/scene.h"

namespace grisaille::lab::claims {

// Adds a horizontal white square below the lowest point of the scene, in its present pose. The
// square is ten times as wide as the scene and never moves.
void addFloor(scene::Scene& scene);

}  // namespace grisaille::lab::claims
