// SPDX-License-Identifier: MIT
// The built-in scenes beside the atrium. core/scene/built_in.h describes them.
#pragma once

#include "core/scene/scene.h"

namespace grisaille::scene {

Scene makeLeaves();
Scene makeGrating();
Scene makeStreet();
Scene makeTable();
Scene makeCarving();

}  // namespace grisaille::scene
