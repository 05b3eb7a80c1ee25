// SPDX-License-Identifier: MIT
// The input of an oracle: the camera of a frame, and the G-buffer attachments that its effects
// read.
//
// This folder computes each effect's algorithm in double precision, from the definition in the
// effect's README. It includes no code of an effect, so that both cannot share an error.
#pragma once

#include <glm/glm.hpp>

#include "core/image/image.h"
#include "core/scene/view.h"

namespace grisaille::lab::oracle {

// Attachments read back from the GPU, all of one size. Those that an oracle does not read may be
// empty.
struct Attachments {
  image::Image depth;      // view depth, metres; 0: sky
  image::Image normal;     // three channels, world
  image::Image back;       // view depth of the visible surface's back, metres; 0: none
  image::Image next;       // view depth of the nearest surface behind that back, metres; 0: none
  image::Image thickness;  // of the matter behind, metres; below 0: unknown
  image::Image colour;     // base colour
};

class View {
 public:
  // `camera` and `size` are the picture's. The attachments extend it by `guard` pixels on each
  // side.
  View(const scene::Camera& camera, const glm::uvec2& size, uint32_t guard,
       Attachments attachments);

  glm::ivec2 size() const { return size_; }
  double nearPlane() const { return nearPlane_; }
  // The camera without guard band.
  const scene::View& camera() const { return camera_; }
  const glm::dvec3& eye() const { return camera_.eye; }
  const glm::dmat3& viewFromWorld() const { return viewFromWorld_; }

  // Whether the attachments hold this pixel of the picture.
  bool holds(const glm::ivec2& pixel) const;

  // View depth of a pixel; beyond the attachments, that of their nearest pixel.
  double depth(const glm::ivec2& pixel) const;
  // View space. A missing normal (shorter than 1/2) is replaced by one that faces the camera.
  glm::dvec3 normal(const glm::ivec2& pixel) const;
  // World space, as in the attachment.
  glm::dvec3 worldNormal(const glm::ivec2& pixel) const;
  // View depth of the surface's back, as with depth(); 0: none.
  double back(const glm::ivec2& pixel) const;
  // View depth of the next surface, as with depth(); 0: none.
  double next(const glm::ivec2& pixel) const;
  // Thickness of the matter behind the surface, as with depth(); below 0: unknown.
  double thickness(const glm::ivec2& pixel) const;
  glm::dvec3 colour(const glm::ivec2& pixel) const;

  // View space: the direction of the ray through a point of the picture in pixels, (0, 0) the top
  // left corner; its z is -1.
  glm::dvec3 ray(const glm::dvec2& point) const;
  // View-space position at a pixel's centre and this view depth.
  glm::dvec3 position(const glm::ivec2& pixel, double depth) const;
  glm::dvec3 position(const glm::ivec2& pixel) const { return position(pixel, depth(pixel)); }

  // Point of the picture, in pixels, of a view-space position in front of the camera.
  glm::dvec2 pixelOf(const glm::dvec3& position) const { return scene::pixelOf(camera_, position); }
  // Unit direction from a view-space position to the camera.
  glm::dvec3 toward(const glm::dvec3& position) const {
    return orthographic() ? glm::dvec3(0, 0, 1) : -glm::normalize(position);
  }
  bool orthographic() const { return camera_.orthographic; }
  // Size of one metre in pixels; perspective: at a view depth of 1 m. y is below 0.
  glm::dvec2 focal() const { return 1.0 / camera_.scale; }
  // Lengths in the picture shrink by this: the view depth, or 1 if orthographic.
  double shrink(double depth) const { return scene::depthScale(camera_, depth); }

 private:
  glm::ivec2 nearest(const glm::ivec2& pixel) const;

  glm::ivec2 size_;
  int guard_;
  double nearPlane_;
  scene::View camera_;
  glm::dmat3 viewFromWorld_;
  Attachments attachments_;
};

// Axes with z along n, a unit vector: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
glm::dmat3 axesAbout(const glm::dvec3& n);

}  // namespace grisaille::lab::oracle
