// SPDX-License-Identifier: MIT
// Casts rays through the scene: primary rays as a reference for the rasteriser, occlusion rays as a
// reference for screen-space occlusion, and rays for effects. Embree finds the triangle; distances,
// positions and normals are then computed in double precision.
//
// Holes: a masked material lets every ray through where its base colour alpha (texture, mip 0,
// bilinear, times factor and vertex colour) is below the cutoff. Rays that ask what can be seen,
// primary rays and those of effects, also pass through the back faces of single-sided materials,
// like the rasteriser. Occlusion rays are blocked from either side.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/occlusion.h"
#include "core/trace/surface_points.h"
#include "grisaille/effect.h"

namespace grisaille::trace {

// The surface that one pixel sees. Vectors are in world axes. Both normals point to the visible
// side: they are flipped where a double-sided surface shows its back.
struct Hit {
  glm::uvec2 pixel = glm::uvec2(0);
  double viewDepth = 0;  // along the view direction, metres; 0: sky, fields below are unset
  glm::dvec3 position = glm::dvec3(0);  // world, metres
  glm::dvec3 facetNormal = glm::dvec3(0);
  glm::vec3 normal = glm::vec3(0);  // interpolated, unit
  float facetReach = 0;  // largest absolute corner coordinate, relative to the origin, metres
  uint32_t instance = 0;
  uint32_t primitive = 0;
  uint32_t material = 0;
};

// What rays from one point meet. A surface's back is the side that its triangles' winding order
// faces away from, also on double-sided materials.
struct Surroundings {
  // The generalised winding number: 1 inside a closed body, 0 outside of all, -1 in a room whose
  // walls have one side. (Jacobson, Kavan and Sorkine-Hornung, "Robust Inside-Outside Segmentation
  // using Generalized Winding Numbers", ACM Transactions on Graphics 32(4), 2013. Here it is the
  // mean over the rays: each crossing counts 1 out of a surface's back, -1 into its front.)
  double winding = 0;
  double met = 0;    // share of the rays that meet a surface
  double backs = 0;  // share of the rays whose first surface shows its back
  double nearest = std::numeric_limits<double>::infinity();  // least distance of a hit, metres
};

class RayTracer {
 public:
  // scene: must outlive the tracer, and change only by scene::pose(): see follow()
  // origin: world position at the centre of interest, for example the camera's eye or the centre of
  //   the scene. Embree works in 32 bits; the tracer first transforms all instances in double to
  //   world space relative to `origin`.
  // Throws kNoCodecs (it cannot decode a mask), kSceneTooLarge, kLeftOut (a build without Embree).
  RayTracer(const scene::Scene& scene, const glm::dvec3& origin);
  ~RayTracer();
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  // Takes the scene's current pose. Call it after scene::pose() and before the next rays; it costs
  // nothing if the pose is the same. Throws kSceneTooLarge.
  void follow();

  // Casts rays from the camera through the pixel centres (x + 0.5, y + 0.5), y down, and clips them
  // at the near plane. Returns one hit per element of `pixels`, in the same order; without
  // `pixels`, one per pixel of the picture, by rows.
  std::vector<Hit> castPrimary(const scene::Camera& camera, uint32_t width, uint32_t height,
                               std::span<const glm::uvec2> pixels) const;
  std::vector<Hit> castPrimary(const scene::Camera& camera, uint32_t width, uint32_t height) const;

  // Casts rays from `point`, with all surfaces that they cross. Directions are unit.
  Surroundings surroundings(const glm::dvec3& point, std::span<const glm::dvec3> directions) const;

  // Finds the first surface that each ray meets within its reach. Backs of single-sided materials
  // let it through, as they are not drawn. `hits` is as long as `rays` and has the same order.
  // Directions are unit. Rays may start far outside the scene. The kind of a hit is never
  // GRISAILLE_HIT_UNKNOWN. A hit depends only on its ray, bit for bit. Neighbours in the array that
  // start and run close together cost far less than others.
  //
  // backs: kBlock: backs of single-sided materials block rays too
  enum class Backs : uint8_t { kPass, kBlock };
  void castRays(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits,
                Backs backs = Backs::kPass) const;

  // Points spread over the scene's surfaces: see surface_points.h.
  SurfacePoints surfacePoints(const SurfaceSpec& spec) const;

  // Casts the rays `from` ... `to` - 1 of each pixel, cosine-weighted about the interpolated
  // normal, and adds to `counts` how many travel `radius` metres unblocked. Rays below the facet
  // are left out. `to` is at most kMostOcclusionRays. Pixel and `seed` determine the sample points.
  // Adding rays in one call or in several gives the same counts, bit for bit. Rays start above the
  // facet by 2e-6 of the largest coordinate involved: about ten times the rounding of the 32-bit
  // triangle.
  void addOcclusion(std::span<const Hit> hits, double radius, uint32_t seed, uint32_t from,
                    uint32_t to, std::span<OcclusionCounts> counts) const;

  // Casts `samples` rays per pixel with addOcclusion() and returns their visibility.
  std::vector<Visibility> ambientOcclusion(std::span<const Hit> hits, double radius,
                                           uint32_t samples, uint32_t seed) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Convert `width` x `height` hits or values, by rows, to pictures.
image::Image depthImage(std::span<const Hit> hits, uint32_t width, uint32_t height);
image::Image normalImage(std::span<const Hit> hits, uint32_t width, uint32_t height);
image::Image visibilityImage(std::span<const Visibility> values, uint32_t width, uint32_t height);
image::Image standardErrorImage(std::span<const Visibility> values, uint32_t width,
                                uint32_t height);

}  // namespace grisaille::trace
