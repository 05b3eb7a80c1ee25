// SPDX-License-Identifier: MIT
// Facet normals from view depth, at places where neighbours show one plane.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "app/apply/picture_checks.h"
#include "core/scene/view.h"

namespace grisaille::app {

class Facets {
 public:
  explicit Facets(const Surfaces& surfaces);

  // The surface that a pixel shows, in view space, metres. Its depth must be above 0.
  glm::dvec3 position(uint32_t x, uint32_t y) const;

  // The direction in which the camera sees that surface, in view space; of any length.
  glm::dvec3 sight(uint32_t x, uint32_t y) const;

  // The facet's unit normal, in view space, towards the camera; none at the picture's border, at
  // edges and where the surface is curved strongly.
  std::optional<glm::dvec3> normal(uint32_t x, uint32_t y) const;

 private:
  double depth(uint32_t x, uint32_t y) const { return double{viewDepth_.at(x, y)}; }

  const image::Image& viewDepth_;
  scene::View view_;
  uint32_t step_;  // distance of the neighbours, pixels
};

}  // namespace grisaille::app
