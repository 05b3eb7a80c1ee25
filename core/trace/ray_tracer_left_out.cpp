// SPDX-License-Identifier: MIT
// Replaces ray_tracer.cpp and buried.cpp in builds without Embree: constructing a tracer throws
// kLeftOut.
#include "core/base/error.h"
#include "core/trace/buried.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::trace {

struct RayTracer::Impl {};

RayTracer::RayTracer(const scene::Scene& /*scene*/, const glm::dvec3& /*origin*/) {
  throw Error(ErrorId::kLeftOut,
              "this build cannot cast rays through the scene: GRISAILLE_TRUTH was off");
}

RayTracer::~RayTracer() = default;

// The functions below are never called, because no tracer exists.

void RayTracer::follow() {}

std::vector<Hit> RayTracer::castPrimary(const scene::Camera& /*camera*/, uint32_t /*width*/,
                                        uint32_t /*height*/,
                                        std::span<const glm::uvec2> /*pixels*/) const {
  return {};
}

std::vector<Hit> RayTracer::castPrimary(const scene::Camera& /*camera*/, uint32_t /*width*/,
                                        uint32_t /*height*/) const {
  return {};
}

Surroundings RayTracer::surroundings(const glm::dvec3& /*point*/,
                                     std::span<const glm::dvec3> /*directions*/) const {
  return {};
}

void RayTracer::castRays(std::span<const grisaille_ray> /*rays*/, std::span<grisaille_hit> /*hits*/,
                         Backs /*backs*/) const {}

std::vector<bool> buriedTriangles(const scene::Scene& scene) {
  return std::vector<bool>(scene.indices.size() / 3);
}

SurfacePoints RayTracer::surfacePoints(const SurfaceSpec& /*spec*/) const {
  return {};
}

void RayTracer::addOcclusion(std::span<const Hit> /*hits*/, double /*radius*/, uint32_t /*seed*/,
                             uint32_t /*from*/, uint32_t /*to*/,
                             std::span<OcclusionCounts> /*counts*/) const {}

std::vector<Visibility> RayTracer::ambientOcclusion(std::span<const Hit> /*hits*/,
                                                    double /*radius*/, uint32_t /*samples*/,
                                                    uint32_t /*seed*/) const {
  return {};
}

}  // namespace grisaille::trace
