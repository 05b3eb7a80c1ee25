// SPDX-License-Identifier: MIT
// Places objects at a pixel, by the placement rule of their table.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "core/effect/instance.h"
#include "core/objects/object.h"
#include "core/scene/camera.h"

namespace grisaille::app {

// Returns `object` with its point field and its direction field set. With surface placement, they
// are the surface point seen at `point` and its normal; with ray placement, the origin and
// the direction of the view ray through `point`. `point`: pixels from the top left corner of a
// picture of `size` pixels. None: surface placement, and no surface is visible at `point`.
std::optional<objects::Object> placedAt(glm::dvec2 point, glm::uvec2 size,
                                        const scene::Camera& camera, effect::RayService& rays,
                                        const objects::Table& table, objects::Object object);

}  // namespace grisaille::app
