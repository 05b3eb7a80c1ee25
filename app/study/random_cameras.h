// SPDX-License-Identifier: MIT
// Draws random cameras inside a scene, at places with a free view.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::app::study {

// Returns at most `count` cameras; fewer if 400 tries per camera find no more. A seed always gives
// the same cameras. `like`: gives angle of view, near plane and size. Every camera satisfies:
//
// - At least half of all directions from the eye hit the scene, none of them closer than 1/100 of
//   the scene's diagonal.
// - The view is level, or looks up or down by at most 0.35 radians.
// - Surfaces cover at least three quarters of the picture, all of them beyond that distance and
// half
//   of them beyond three times that distance.
// - At most 5 % of these surfaces are seen through the back of another surface, as from the inside
//   of a wall.
std::vector<scene::Camera> randomCameras(const scene::Scene& scene, const scene::Camera& like,
                                         size_t count, uint32_t seed);

}  // namespace grisaille::app::study
