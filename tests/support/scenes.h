// SPDX-License-Identifier: MIT
// Small scenes for tests.
#pragma once

#include <array>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::tests {

// Adds a quad with one normal, counter-clockwise as listed, as an instance of its own.
void addQuad(scene::Scene& scene, const std::array<glm::vec3, 4>& corners, glm::vec3 normal,
             uint32_t material = 0);

// The floor y = 0, `size` metres a side, about the origin, one white material.
scene::Scene floorScene(float size = 100);

// The same with a wall at z = 0 that rises from it, facing +z.
scene::Scene cornerScene(float size = 100);

// A wall at z = 0 about the origin, metres, facing +z, one white material.
scene::Scene wallScene(float width = 40, float height = 40);

}  // namespace grisaille::tests
