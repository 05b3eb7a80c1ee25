// SPDX-License-Identifier: MIT
// Points spread over a scene's surfaces in proportion to their area.
#pragma once

#include <cstdint>
#include <vector>

#include "grisaille/effect.h"

namespace grisaille::trace {

class TracedScene;

struct SurfaceSpec {
  uint32_t count = 0;  // of points, before those in holes are left out
  // Largest angle between a surface's normal and +y, radians: pi for all surfaces, less for floors
  // and slopes.
  double steepest = 0;
  uint32_t seed = 0;
};

// Each point stands for the same area. Points of one triangle follow each other.
struct SurfacePoints {
  std::vector<grisaille_point> points;
  double area = 0;  // of all points together, square metres
};

// Samples the sides of triangles that a camera can see: the front, and of two-sided materials the
// back too, without the holes of masks. The same arguments give the same points, bit for bit.
SurfacePoints surfacePoints(const TracedScene& scene, const SurfaceSpec& spec);

}  // namespace grisaille::trace
