// SPDX-License-Identifier: MIT
// Tells solid bodies from sheets. A body's surface encloses matter, so that its far side is its
// back. A sheet, such as a leaf or a banner, has no thickness, and its back is its front. Exporters
// mark bodies as double-sided too: only the mesh itself tells. It also tells how thick a body is on
// average.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace grisaille::scene {

// The matter behind each triangle of Scene::indices.
struct Matter {
  // Whether the triangle belongs to a body.
  std::vector<bool> bodies;
  // How thick the matter is, in units of the object; -1: unknown. A body's mean chord, 4 times its
  // volume over its surface (Cauchy's formula, exact for convex bodies: Santalo, "Integral Geometry
  // and Geometric Probability", 1976); 0 for other triangles with a double-sided or masked
  // material, which are sheets; unknown for the rest, such as the walls of a room.
  std::vector<float> thickness;
  // For each primitive, the area of the parts that it belongs to, in square units of the object.
  // The three axes share it by the squares of the normals' components.
  std::vector<glm::dvec3> areas;
};

// Vertices at equal positions count as one. Triangles that share an edge belong to one part; a part
// may span several primitives, if their instances have equal transforms. A part is a body in either
// case:
//
// - it is closed: each of its edges runs as often one way as the other;
// - just below its surface, its generalised winding number is at least 0.65 on average. A flat
// sheet
//   has 0.5, a closed body 1; a body with cracks or without a bottom is near 1. Jacobson, Kavan and
//   Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding Numbers", ACM
//   Transactions on Graphics 32(4), 2013.
//
// Triangles with a masked material or without an area belong to no part. A primitive with several
// instances must be part of bodies in each; its thickness is the least of them. Takes the scene in
// its present pose. Time: that of sorting the scene's edges, and of 16 solid angles for each
// triangle of a part that is not closed.
Matter matterOf(const Scene& scene);

// The factor on the mean chord of a body whose surface has these Matter::areas, if `linear`
// transforms it: that of its volume over that of its surface. Exact for boxes along the axes, and
// for any body if `linear` stretches all directions alike; 0 for a surface without an area.
double chordScale(const glm::dvec3& areas, const glm::dmat3& linear);

// The thickness at each vertex of the scene: that of a triangle with this vertex.
std::vector<float> vertexThickness(const Scene& scene, const Matter& matter);

}  // namespace grisaille::scene
