// SPDX-License-Identifier: MIT
#include "core/trace/surface_points.h"

#include <algorithm>
#include <cmath>

#include "core/trace/sampling.h"
#include "core/trace/traced_scene.h"

namespace grisaille::trace {
namespace {

// One side of a triangle.
struct TriangleSide {
  Triangle triangle;
  bool back = false;
  double end = 0;  // sum of the areas up to this one, square metres
};

// The unit normal of a facet, on the front of its triangle. `length`: of its cross product, over 0.
glm::dvec3 frontOf(const TracedScene& scene, uint32_t instance, const Facet& facet, double length) {
  return facet.cross * ((scene.placement(instance).mirrored ? -1.0 : 1.0) / length);
}

std::vector<TriangleSide> sidesOf(const TracedScene& traced, double steepest) {
  const scene::Scene& scene = traced.scene();
  const double least = std::cos(steepest) - 1e-9;
  std::vector<TriangleSide> sides;
  double area = 0;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Primitive& primitive = scene.primitives[scene.instances[i].primitive];
    const bool twoSided = scene.materials[primitive.material].doubleSided;
    for (uint32_t k = 0; k < primitive.indexCount; k += 3) {
      const Triangle triangle = {.instance = i, .firstIndex = primitive.firstIndex + k};
      const Facet facet = traced.facet(triangle);
      const double length = glm::length(facet.cross);
      if (!(length > 0)) continue;
      const double up = frontOf(traced, i, facet, length).y;
      for (const bool back : {false, true}) {
        if ((back && !twoSided) || (back ? -up : up) < least) continue;
        area += length / 2;
        sides.push_back({.triangle = triangle, .back = back, .end = area});
      }
    }
  }
  return sides;
}

}  // namespace

// Systematic sampling: point i lies at (i + 1/2) / count of the area, so that each triangle gets
// its share of the points, rounded up or down. Within the triangle, points follow a Sobol sequence.
SurfacePoints surfacePoints(const TracedScene& traced, const SurfaceSpec& spec) {
  const std::vector<TriangleSide> sides = sidesOf(traced, spec.steepest);
  SurfacePoints sampled;
  if (sides.empty() || spec.count == 0) return sampled;
  const double each = sides.back().end / spec.count;
  sampled.points.reserve(spec.count);
  auto side = sides.begin();
  for (uint32_t i = 0; i < spec.count; ++i) {
    const double at = (i + 0.5) * each;
    while (side->end < at && side + 1 != sides.end()) ++side;
    const glm::vec2 unit = sobolPoint(i, spec.seed);
    // Uniform in the triangle: Osada et al. 2002, "Shape Distributions", section 4.2.
    const float root = std::sqrt(unit.x);
    const float u = root * (1 - unit.y), v = root * unit.y;
    if (traced.isHole(side->triangle, u, v)) continue;
    const Facet facet = traced.facet(side->triangle);
    const auto& c = facet.corners;
    const glm::dvec3 position =
        traced.origin() + c[0] + double{u} * (c[1] - c[0]) + double{v} * (c[2] - c[0]);
    const glm::dvec3 front =
        frontOf(traced, side->triangle.instance, facet, glm::length(facet.cross));
    const glm::vec3 normal(side->back ? -front : front);
    sampled.points.push_back({.position = {position.x, position.y, position.z},
                              .normal = {normal.x, normal.y, normal.z},
                              .reserved = 0});
  }
  sampled.area = each * static_cast<double>(sampled.points.size());
  return sampled;
}

}  // namespace grisaille::trace
