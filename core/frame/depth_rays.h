// SPDX-License-Identifier: MIT
// Rays answered from a rendered frame, for hosts without geometry on the CPU.
//
// What is drawn is the world: what the frame cuts out or leaves out (holes of alpha masks, back
// faces of single-sided materials) is not there for these rays, and nothing is where nothing can be
// drawn: within the near plane's distance of the eye, and between there and the near plane's part
// in the picture. From the eye, the pixel that a direction falls in tells. From elsewhere, a ray is
// followed across the picture for as long as it lies in front of what each pixel shows, and hits
// where it crosses the facet that a pixel shows.
//
// Unknown is what the frame does not show: rays that start or go on outside the picture or behind a
// surface that they did not cross, and those that pass an edge so near that the pixels on either
// side of it tell different things. What is smaller than a pixel may be missed all the same.
#pragma once

#include <vector>

#include "core/effect/instance.h"
#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::frame {

class DepthRays : public effect::RayService {
 public:
  // "depth" and "facet_normal" of one frame, as Renderer::read() gives them, and its camera. Throws
  // kImageMismatch where they are not of one size, kCameraInvalid.
  DepthRays(const image::Image& depth, const image::Image& facetNormal,
            const scene::Camera& camera);

  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override;

 private:
  // What a pixel shows: a plane. Inverse view depth is linear over the picture, on a plane as well
  // as along a ray.
  struct Facet {
    float depth = 0;                  // inverse, at the pixel's centre, 1/m; 0: sky
    glm::vec2 slope = glm::vec2(0);   // of the inverse depth, a pixel
    glm::vec3 normal = glm::vec3(0);  // world; 0 where the frame has none
    bool edge = false;                // beside it another surface is seen
  };
  struct Path;

  void findEdges();
  grisaille_hit cast(const grisaille_ray& ray) const;
  bool lay(const grisaille_ray& ray, Path& path, uint32_t& answer) const;
  grisaille_hit follow(const grisaille_ray& ray, const Path& path) const;
  grisaille_hit hitAt(const grisaille_ray& ray, const Path& path, const Facet& facet,
                      double share) const;
  bool contested(const Path& path, const glm::ivec2& pixel, double enter, double leave,
                 bool hits) const;
  bool inPicture(const glm::ivec2& pixel) const;
  size_t indexOf(const glm::ivec2& pixel) const;
  double shownAt(const glm::ivec2& pixel, const glm::dvec2& place) const;
  bool goesOn(const glm::ivec2& pixel, const glm::ivec2& other) const;

  glm::dvec2 size_;
  double focal_ = 0;  // pixels at a view depth of 1
  double near_ = 0;   // metres
  glm::dvec3 eye_;
  glm::dmat3 viewFromWorld_;
  std::vector<Facet> facets_;  // by rows
};

}  // namespace grisaille::frame
