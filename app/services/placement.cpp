// SPDX-License-Identifier: MIT
#include "app/services/placement.h"

#include <limits>
#include <span>

namespace grisaille::app {

std::optional<objects::Object> placedAt(glm::dvec2 point, glm::uvec2 size,
                                        const scene::Camera& camera, effect::RayService& rays,
                                        const objects::Table& table, objects::Object object) {
  const glm::dvec3 towards = scene::pixelDirection(camera, size.x, size.y, point);
  const glm::vec3 unit(glm::normalize(towards));
  glm::dvec3 place = camera.eye;
  glm::vec3 direction = unit;
  if (table.placement == GRISAILLE_PLACE_SURFACE) {
    const grisaille_ray ray = {.origin = {camera.eye.x, camera.eye.y, camera.eye.z},
                               .direction = {unit.x, unit.y, unit.z},
                               .reach = std::numeric_limits<float>::infinity()};
    grisaille_hit hit = {};
    rays.cast(std::span(&ray, 1), std::span(&hit, 1));
    if (hit.kind != GRISAILLE_HIT_SURFACE) return std::nullopt;
    place = camera.eye + double{hit.distance} * glm::normalize(towards);
    direction = {hit.normal[0], hit.normal[1], hit.normal[2]};
  }
  object.values[table.point_field].numbers = {place.x, place.y, place.z};
  object.values[table.direction_field].numbers = {direction.x, direction.y, direction.z};
  return object;
}

}  // namespace grisaille::app
