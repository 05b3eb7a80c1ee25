// SPDX-License-Identifier: MIT
// The plane of the facet that a pixel shows, as shaders/ssao/facet.glsl and plane.glsl have it.
#pragma once

#include "lab/oracle/view.h"

namespace grisaille::lab::oracle {

class Facet {
 public:
  // Of a pixel that shows a surface. Its plane tolerance is 0.05 radii or the width of `pixels`
  // pixels, whichever is less. `radius`: metres. `stored`: its slopes are rounded to half floats,
  // as the shaders keep those of texels. In very wide pictures that decides which facet is nearest.
  Facet(const View& view, const glm::ivec2& pixel, double pixels, double radius, bool stored);

  // Distance from the plane of the point that `pixel` would show at view depth `depth`, in
  // tolerances.
  double off(const View& view, const glm::ivec2& pixel, double depth) const;

 private:
  glm::dvec3 position_, normal_{0};  // view space
  double tolerance_;                 // metres
};

}  // namespace grisaille::lab::oracle
