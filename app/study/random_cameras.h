// SPDX-License-Identifier: MIT
// Cameras drawn at random inside a scene, where the view isn't blocked.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::app::study {

// At most `count`, fewer where so many tries find no more; each seed draws the same ones always.
// An eye stands in free space: half of all directions meet the scene at least, none closer than a
// hundredth of the scene's diagonal; a view looks level or somewhat up or down, sees surfaces on
// three quarters of the picture at least, half of them farther than three times that distance, and
// hardly any through the back of something, as from inside of a wall.
// `like` gives angle, near plane and size.
std::vector<scene::Camera> randomCameras(const scene::Scene& scene, const scene::Camera& like,
                                         size_t count, uint32_t seed);

}  // namespace grisaille::app::study
