// SPDX-License-Identifier: MIT
// Objects placed with the pointer, as their table says.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "core/effect/instance.h"
#include "core/objects/object.h"
#include "core/scene/camera.h"

namespace grisaille::app {

// `object` with the point and the direction that placing it at a pixel of a picture of `size` sets;
// `point`: pixels from the picture's top left corner. None: nothing is seen there that it could be
// placed on.
std::optional<objects::Object> placedAt(glm::dvec2 point, glm::uvec2 size,
                                        const scene::Camera& camera, effect::RayService& rays,
                                        const objects::Table& table, objects::Object object);

}  // namespace grisaille::app
