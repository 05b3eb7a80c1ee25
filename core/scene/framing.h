// SPDX-License-Identifier: MIT
// Chooses a camera for a scene that has none.
#pragma once

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::scene {

// A camera that sees every vertex of the scene, as large as the picture allows, from a direction in
// which the scene covers much of it and shows much of its surface. Inside a scene that encloses its
// surfaces, such as a room, a camera in it that looks across it, and not through a wall whose back
// is not drawn. The same scene and shape give the same camera.
// aspect: width of the picture divided by its height
Camera framingCamera(const Scene& scene, double aspect);

// The same for one of the scene's animations: sees every vertex at 17 times from its start to its
// end, from a direction chosen for the start. Leaves the scene at rest. Throws as pose() does.
Camera framingCamera(Scene& scene, size_t animation, double aspect);

}  // namespace grisaille::scene
