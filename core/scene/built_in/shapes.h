// SPDX-License-Identifier: MIT
// Solids of the built-in scenes, beyond those of mesh_builder.h. Lengths are in metres.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/scene/mesh_builder.h"

namespace grisaille::scene {

using Path = std::vector<glm::dvec3>;

// 0 up to t = 0, 1 from t = 1, and a smooth rise between.
double smoothUnit(double t);

// A pseudo-random number between two values.
double hashBetween(uint32_t seed, double low, double high);

// Smooth noise over the plane, -1 ... 1, with features of size 1.
double noise(double x, double y, uint32_t seed);

// Transforms. Angles are in turns; positive ones turn +y to +z, and +x to +y.
glm::dmat4 turnedX(double turns);
glm::dmat4 turnedZ(double turns);
glm::dmat4 scaled(const glm::dvec3& by);
// Moves the origin to `from` and turns +y to `direction`, which need not be unit.
glm::dmat4 aimed(const glm::dvec3& from, const glm::dvec3& direction);

// A smooth curve (Catmull and Rom) through all points. steps: number of segments between two points
Path curve(std::span<const glm::dvec3> points, uint32_t steps);

// A line whose inner corners are rounded. radius: distance from a corner to the start of its bend
Path bent(std::span<const glm::dvec3> points, double radius, uint32_t steps);

// A cable that hangs between two points. sag: depth of its middle below the straight line
Path hanging(const glm::dvec3& from, const glm::dvec3& to, double sag, uint32_t steps);

// Sweeps a cross-section along a path.
// section: points (sideways, up) around the path; a loop that its centre sees
// up: the section's "up" at the start; it turns with the path as little as possible
// scale: size of the section at each point of the path; empty: 1
Solid sweep(std::span<const glm::dvec2> section, const Path& path, const glm::dvec3& up,
            std::span<const double> scale = {});

// A round tube. radii: at each point of the path, or a single one
Solid tube(const Path& path, std::span<const double> radii, uint32_t sides);
Solid tube(const Path& path, double radius, uint32_t sides);

// A round tube along a closed path, which lies in a plane.
Solid hoop(const Path& path, double radius, uint32_t sides);

// A torus round the y axis.
Solid torus(double radius, double thickness, uint32_t segments, uint32_t sides);

// A ball round the origin, with `rows` rows of faces from pole to pole.
Solid ball(double radius, uint32_t segments, uint32_t rows);

// A box with a bevel along each of its edges.
Solid block(const glm::dvec3& low, const glm::dvec3& high, double bevel);

// The prism over an outline of (x, z) points, which its centre sees, between two heights. `bevel`:
// width of the bevel of the upper edges, 0: none; it shrinks the outline towards its centre.
Solid prism(std::span<const glm::dvec2> outline, double low, double high, double bevel = 0);

// Ground: a height field over a rectangle of the xz plane, with a flat bottom.
// height: of the point (x, z)
Solid ground(const glm::dvec2& low, const glm::dvec2& high, const glm::uvec2& cells, double bottom,
             const std::function<double(double x, double z)>& height);

// A wall that faces +z at z = 0, with recesses.
// xs, ys: lines of a grid, ascending
// depth: of the cell in a column and a row; 0: no recess. Recesses touch neither each other, not
//     even in a corner, nor the border
// thickness: of the wall, above the depth of each recess
Solid recessedWall(std::span<const double> xs, std::span<const double> ys,
                   const std::function<double(uint32_t column, uint32_t row)>& depth,
                   double thickness);

}  // namespace grisaille::scene
