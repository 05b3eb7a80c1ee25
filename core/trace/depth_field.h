// SPDX-License-Identifier: MIT
// The screen-space ceiling: the ambient visibility that a depth buffer allows at best.
//
// The rays are those of the traced truth, but what blocks them is only what the picture shows. Each
// pixel stands for the plane of the facet that its centre hits, as far as the pixel reaches, and
// for the matter behind it: a point is inside it when its view depth is beyond the plane's at the
// same place of the picture by `thickness` at most. A ray is open unless a point of it is inside,
// so it is open beyond that, where it leaves the picture, before the near plane and over the sky.
//
// Planes, not the surface that is bilinear between centres: that one spans from a silhouette to
// what lies behind, a wall that is nowhere in the scene. Nor flat texels, which make steps of a
// slanting floor. docs/manual/truth.md has its error on Crytek Sponza.
#pragma once

#include "core/trace/projection.h"

namespace grisaille::trace {

class DepthField {
 public:
  // `hits`: all pixels of the picture by rows.
  DepthField(std::span<const Hit> hits, const scene::Camera& camera, uint32_t width,
             uint32_t height);

  // As RayTracer::addOcclusion(), to the ray, for any pixels of the picture. `thickness`: metres of
  // view depth, over 0.
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
