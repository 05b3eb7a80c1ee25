// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

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

// Draws an effect's depth pictures with the ray tracer, rounded as a depth buffer of 24 bits does
// whose planes are 0.05 m and 500 m away.
class TracedDepths : public effect::DepthService {
 public:
  explicit TracedDepths(const trace::RayTracer& tracer) : tracer_(tracer) {}
  void draw(const grisaille_depth_view& view, std::span<float> depth) override;
  // Number of pictures.
  size_t count() const { return count_; }

 private:
  const trace::RayTracer& tracer_;
  size_t count_ = 0;
};

inline void TracedDepths::draw(const grisaille_depth_view& view, std::span<float> depth) {
  ++count_;
  const glm::vec3 way(view.direction[0], view.direction[1], view.direction[2]);
  const glm::vec3 up(view.up[0], view.up[1], view.up[2]), right = glm::cross(way, up);
  std::vector<grisaille_ray> rays(depth.size());
  std::vector<grisaille_hit> hits(depth.size());
  const auto middle = [&](size_t pixel) {
    return view.slope *
           (2 * (static_cast<float>(pixel) + 0.5f) / static_cast<float>(view.size) - 1);
  };
  for (size_t i = 0; i < rays.size(); ++i) {
    const glm::vec3 unit =
        glm::normalize(way + middle(i % view.size) * right - middle(i / view.size) * up);
    rays[i] = {.origin = {view.origin[0], view.origin[1], view.origin[2]},
               .direction = {unit.x, unit.y, unit.z},
               .reach = std::numeric_limits<float>::infinity()};
  }
  tracer_.castRays(rays, hits);
  constexpr double kNear = 0.05, kFar = 500, kSteps = 1 << 24;
  for (size_t i = 0; i < rays.size(); ++i) {
    const auto& unit = rays[i].direction;
    const double metres =
        double{hits[i].distance} * glm::dot(glm::vec3(unit[0], unit[1], unit[2]), way);
    const double stored = (1 / kNear - 1 / metres) / (1 / kNear - 1 / kFar);
    const double rounded = std::round(glm::clamp(stored, 0.0, 1.0) * kSteps) / kSteps;
    depth[i] = hits[i].kind == GRISAILLE_HIT_SURFACE
                   ? static_cast<float>(1 / (1 / kNear - rounded * (1 / kNear - 1 / kFar)))
                   : std::numeric_limits<float>::infinity();
  }
}

// Whether nothing lies between a muzzle and a point of a surface.
inline bool sees(const trace::RayTracer& tracer, const glm::dvec3& muzzle,
                 const glm::dvec3& position, const glm::dvec3& normal) {
  const glm::dvec3 way = position + 1e-4 * normal - muzzle;
  const glm::vec3 unit(glm::normalize(way));
  const grisaille_ray ray = {.origin = {muzzle.x, muzzle.y, muzzle.z},
                             .direction = {unit.x, unit.y, unit.z},
                             .reach = static_cast<float>(glm::length(way))};
  grisaille_hit hit = {};
  tracer.castRays({&ray, 1}, {&hit, 1});
  return hit.kind == GRISAILLE_HIT_NONE;
}

}  // namespace grisaille::tests
