// SPDX-License-Identifier: MIT
// Small scenes for tests.
#pragma once

#include <array>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::tests {

// Adds an instance of a quad with one normal. The corners are in counter-clockwise order.
void addQuad(scene::Scene& scene, const std::array<glm::vec3, 4>& corners, glm::vec3 normal,
             uint32_t material = 0);

// Adds a closed box, from -1 to 1 along each axis, as six primitives with outward normals: the
// sides at -x, +x, -y, +y, -z and +z. Each has an instance with this transform.
void addBox(scene::Scene& scene, const glm::dmat4& worldFromObject, uint32_t material = 0);

// The floor y = 0, centred at the origin, `size` metres on each side, with one white material.
scene::Scene floorScene(float size = 100);

// floorScene() with a wall at z = 0 that rises from the floor and faces +z.
scene::Scene cornerScene(float size = 100);

// A wall at z = 0, centred at the origin, sizes in metres. It faces +z and has one white material.
scene::Scene wallScene(float width = 40, float height = 40);

}  // namespace grisaille::tests
