// SPDX-License-Identifier: MIT
// Rays: what effects ask of the scene, what the rasteriser should have drawn, and what a
// screen-space occlusion approximates. Embree finds the triangle; the numbers that matter are then
// worked out in double.
//
// Holes: texels of a masked material whose base colour alpha (texture, mip 0, bilinear, times the
// factor) is under the cutoff let every ray through. Primary rays also pass through the back faces
// of single-sided materials, as drawing does; all others are blocked from either side.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/occlusion.h"
#include "grisaille/effect.h"

namespace grisaille::trace {

// What one pixel sees. Vectors are in world axes; both normals point to the side that is seen: they
// are turned round where a double-sided surface shows its back.
struct Hit {
  glm::uvec2 pixel = glm::uvec2(0);
  double viewDepth = 0;                 // along the view direction, metres; 0: sky, the rest unset
  glm::dvec3 position = glm::dvec3(0);  // world, metres
  glm::dvec3 facetNormal = glm::dvec3(0);
  glm::vec3 normal = glm::vec3(0);  // interpolated, unit
  float facetReach = 0;             // largest coordinate of a corner, from the origin, metres
  uint32_t instance = 0;
  uint32_t primitive = 0;
  uint32_t material = 0;
};

class RayTracer {
 public:
  // `scene` outlives the tracer. Embree works in 32 bits, so all instances are put into world space
  // relative to `origin` in double first: give a point in the midst of what matters, as the
  // camera's eye or the scene's centre. Throws kSceneImage (a mask that does not decode),
  // kSceneTooLarge.
  RayTracer(const scene::Scene& scene, const glm::dvec3& origin);
  ~RayTracer();
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  // Rays through pixel centres, as the camera's pinhole draws them: (x + 0.5, y + 0.5), y down. The
  // near plane cuts. One hit a pixel, in the order given; without `pixels`, all of them by rows.
  std::vector<Hit> castPrimary(const scene::Camera& camera, uint32_t width, uint32_t height,
                               std::span<const glm::uvec2> pixels) const;
  std::vector<Hit> castPrimary(const scene::Camera& camera, uint32_t width, uint32_t height) const;

  // What each ray meets first within its reach, one an element of `hits`, which is as long: from
  // either side, also the back of a single-sided material. Directions are unit. Rays may start far
  // outside the scene. Never kind GRISAILLE_HIT_UNKNOWN. A hit depends on its ray alone, to the
  // bit; neighbours in the array that start and run close together cost far less than others.
  void castRays(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) const;

  // Casts the rays `from` ... `to` - 1 of each pixel, cosine-weighted about the interpolated
  // normal, and counts which travel `radius` metres unblocked; those under the facet are left out.
  // Points are seeded by pixel and `seed`. Adding rays in one go or in several comes to the same,
  // to the bit; `to` is kMostOcclusionRays at most. Rays start off the facet by 2e-6 of the largest
  // coordinate involved: some ten times the rounding of the 32-bit triangle.
  void addOcclusion(std::span<const Hit> hits, double radius, uint32_t seed, uint32_t from,
                    uint32_t to, std::span<OcclusionCounts> counts) const;

  // All of `samples` rays at once.
  std::vector<Visibility> ambientOcclusion(std::span<const Hit> hits, double radius,
                                           uint32_t samples, uint32_t seed) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Pictures of `width` x `height` hits by rows.
image::Image depthImage(std::span<const Hit> hits, uint32_t width, uint32_t height);
image::Image normalImage(std::span<const Hit> hits, uint32_t width, uint32_t height);
image::Image visibilityImage(std::span<const Visibility> values, uint32_t width, uint32_t height);
image::Image standardErrorImage(std::span<const Visibility> values, uint32_t width,
                                uint32_t height);

}  // namespace grisaille::trace
