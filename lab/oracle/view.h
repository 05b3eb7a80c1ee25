// SPDX-License-Identifier: MIT
// What a frame showed its effects, for working an effect out once more in double precision: the
// attachments as they were read back, and the camera.
//
// This room holds each effect's algorithm from its README's definition. It sees no code of an
// effect, so that an error of one is none of the other.
#pragma once

#include <glm/glm.hpp>

#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::lab::oracle {

// As they were read back, all of one size. What is not read may be empty.
struct Attachments {
  image::Image depth;   // view depth, metres; 0: sky
  image::Image normal;  // three channels, world
  image::Image back;    // view depth where the matter that is seen ends, metres; 0: none
  image::Image colour;  // base colour
};

class View {
 public:
  // The attachments go beyond a picture of this size by `guard` pixels on each side. `camera` is
  // the picture's.
  View(const scene::Camera& camera, const glm::uvec2& size, uint32_t guard,
       Attachments attachments);

  glm::ivec2 size() const { return size_; }
  double nearPlane() const { return nearPlane_; }
  const glm::dvec3& eye() const { return eye_; }
  const glm::dmat3& viewFromWorld() const { return viewFromWorld_; }

  // Whether the attachments hold this pixel of the picture.
  bool holds(const glm::ivec2& pixel) const;

  // Of a pixel; beyond the attachments that of their nearest one.
  double depth(const glm::ivec2& pixel) const;
  // In view space; what has no direction faces the camera.
  glm::dvec3 normal(const glm::ivec2& pixel) const;
  // In the world, as it was read.
  glm::dvec3 worldNormal(const glm::ivec2& pixel) const;
  // As depth(); 0: none.
  double back(const glm::ivec2& pixel) const;
  glm::dvec3 colour(const glm::ivec2& pixel) const;

  // Through a point of the picture, (0, 0) its top left corner; z is -1.
  glm::dvec3 ray(const glm::dvec2& point) const;
  // What a pixel's centre would show at this depth.
  glm::dvec3 position(const glm::ivec2& pixel, double depth) const;
  glm::dvec3 position(const glm::ivec2& pixel) const { return position(pixel, depth(pixel)); }

  // Pixels that one metre takes up at a view depth of one.
  glm::dvec2 focal() const { return focal_; }

 private:
  glm::ivec2 nearest(const glm::ivec2& pixel) const;

  glm::ivec2 size_;
  int guard_;
  double nearPlane_;
  glm::dvec2 focal_;  // y is negative: pixels go down
  glm::dvec3 eye_;    // world
  glm::dmat3 viewFromWorld_;
  Attachments attachments_;
};

// Axes with z along n, a unit vector: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
glm::dmat3 axesAbout(const glm::dvec3& n);

}  // namespace grisaille::lab::oracle
