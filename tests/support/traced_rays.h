// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace grisaille::tests
