// SPDX-License-Identifier: MIT
// Rays through the scene for effects that ask. Embree's scene is built with the first.
#pragma once

#include <optional>

#include "core/effect/instance.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::app {

class SceneRays : public effect::RayService {
 public:
  // `scene` outlives this and stays unchanged.
  explicit SceneRays(const scene::Scene& scene) : scene_(scene) {}

  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override {
    if (!tracer_) tracer_.emplace(scene_, (scene_.bounds.min + scene_.bounds.max) / 2.0);
    tracer_->castRays(rays, hits);
  }

 private:
  const scene::Scene& scene_;
  std::optional<trace::RayTracer> tracer_;
};

}  // namespace grisaille::app
