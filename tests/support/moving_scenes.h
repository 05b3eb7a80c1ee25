// SPDX-License-Identifier: MIT
// Scenes whose parts move, made in code.
#pragma once

#include "core/scene/scene.h"

namespace grisaille::tests {

// A box, 0.6 m on each side, on the floor of cornerScene(), with its centre at (x, 0.3, 0.5). Its
// six faces are the last six instances.
scene::Scene boxOnFloor(double x);

// Moves the box of boxOnFloor(), and counts a pose.
void moveBox(scene::Scene& scene, double x);

}  // namespace grisaille::tests
