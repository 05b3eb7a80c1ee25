// SPDX-License-Identifier: MIT
// The screen-space ceiling: the best ambient visibility that a depth buffer allows.
//
// It casts the rays of the traced truth, but only visible surfaces block them. Each pixel stands
// for the plane of the facet at its centre, clipped to the pixel, with a solid behind it: a point
// is inside the solid if its view depth exceeds that of the plane, at the same place of the
// picture, by at most `thickness`. A ray is blocked if one of its points is inside a solid. Behind
// the solids, outside the picture, in front of the near plane and over the sky, nothing blocks it.
//
// A bilinear surface between pixel centres would connect a silhouette to the background by a wall
// that the scene does not have. Constant depth per texel would turn a slanting floor into steps.
// docs/manual/truth.md has the error of the ceiling on Crytek Sponza.
#pragma once

#include "core/trace/projection.h"

namespace grisaille::trace {

class DepthField {
 public:
  // `hits`: castPrimary() of all pixels of the picture, by rows.
  DepthField(std::span<const Hit> hits, const scene::Camera& camera, uint32_t width,
             uint32_t height);

  // Same as RayTracer::addOcclusion(), with the same rays, for any pixels of the picture.
  // `thickness`: metres of view depth, above 0.
  void addOcclusion(std::span<const Hit> hits, double radius, double thickness, uint32_t seed,
                    uint32_t from, uint32_t to, std::span<OcclusionCounts> counts) const;

 private:
  struct Path;
  bool isOpen(const Path& path, double thickness) const;

  Projection projection_;
  double nearPlane_;
  uint32_t width_, height_;
  std::vector<FacetPlane> planes_;
};

}  // namespace grisaille::trace
