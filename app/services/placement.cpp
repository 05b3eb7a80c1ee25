// SPDX-License-Identifier: MIT
#include "app/services/placement.h"

#include <limits>
#include <span>

#include "core/scene/view.h"

namespace grisaille::app {

std::optional<objects::Object> placedAt(glm::dvec2 point, glm::uvec2 size,
                                        const scene::Camera& camera, effect::RayService& rays,
                                        const objects::Table& table, objects::Object object) {
  const auto [origin, towards] = scene::rayAt(scene::viewOf(camera, size), point);
  const glm::vec3 unit(glm::normalize(towards));
  glm::dvec3 place = origin;
  glm::vec3 direction = unit;
  if (table.placement == GRISAILLE_PLACE_SURFACE) {
    const grisaille_ray ray = {.origin = {origin.x, origin.y, origin.z},
                               .direction = {unit.x, unit.y, unit.z},
                               .reach = std::numeric_limits<float>::infinity()};
    grisaille_hit hit = {};
    rays.cast(std::span(&ray, 1), std::span(&hit, 1));
    if (hit.kind != GRISAILLE_HIT_SURFACE) return std::nullopt;
    place = origin + double{hit.distance} * glm::normalize(towards);
    direction = {hit.normal[0], hit.normal[1], hit.normal[2]};
  }
  object.values[table.point_field].numbers = {place.x, place.y, place.z};
  object.values[table.direction_field].numbers = {direction.x, direction.y, direction.z};
  return object;
}

}  // namespace grisaille::app
