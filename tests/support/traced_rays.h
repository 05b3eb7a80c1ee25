// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "core/effect/instance.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::tests {

// Casts an effect's rays through the ray tracer, as the program does, and counts them.
class TracedRays : public effect::RayService {
 public:
  explicit TracedRays(const scene::Scene& scene)
      : tracer_(scene, (scene.bounds.min + scene.bounds.max) / 2.0) {}
  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override {
    tracer_.castRays(rays, hits);
    count_ += rays.size();
  }
  size_t count() const { return count_; }
  const trace::RayTracer& tracer() const { return tracer_; }

 private:
  trace::RayTracer tracer_;
  size_t count_ = 0;
};

// Whether nothing lies between a muzzle and a point of a surface.
inline bool sees(const trace::RayTracer& tracer, const glm::dvec3& muzzle,
                 const glm::dvec3& position, const glm::dvec3& normal) {
  const glm::dvec3 start = position + 1e-4 * normal, back = muzzle - start;
  const glm::vec3 unit(glm::normalize(back));
  const grisaille_ray ray = {.origin = {start.x, start.y, start.z},
                             .direction = {unit.x, unit.y, unit.z},
                             .reach = static_cast<float>(glm::length(back))};
  grisaille_hit hit = {};
  tracer.castRays({&ray, 1}, {&hit, 1});
  return hit.kind == GRISAILLE_HIT_NONE;
}

}  // namespace grisaille::tests
