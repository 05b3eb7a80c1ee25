// SPDX-License-Identifier: MIT
// Generators of solids. They use only additions, products, quotients and square roots, which give
// the same bits on every machine.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/scene/scene.h"

namespace grisaille::scene {

// A triangle mesh. All triangles that meet at a point share its position. Triangles are
// counter-clockwise when seen from outside.
struct Solid {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> texCoords;  // one per position
  std::vector<uint32_t> indices;
};

using Ring = std::vector<glm::dvec3>;

// Sine and cosine of an angle in turns.
double sinTurns(double turns);
double cosTurns(double turns);

// A pseudo-random number in [0, 1) that depends only on the seed.
double hashUnit(uint32_t seed);

// Skins a sequence of rings with equal numbers of points. `loop`: joins the last ring to the first;
// else two caps close the solid. The centre of a cap must see all of its edges.
Solid loft(std::span<const Ring> rings, bool loop);

// An axis-aligned box. `bevel`: width of the bevel of the upper edges, 0: none.
Solid box(const glm::dvec3& low, const glm::dvec3& high, double bevel = 0);

// Revolves a profile of (radius, height) points about the y axis. Radii are above 0.
// segments: number of points of each ring
// flutes: number of vertical grooves
// depth: depth of the grooves, as a fraction of the radius
Solid lathe(std::span<const glm::dvec2> profile, uint32_t segments, uint32_t flutes = 0,
            double depth = 0);

// A moulding round a rectangle that is centred on the y axis. Profile points are (distance inwards
// from the rectangle, height).
Solid frame(std::span<const glm::dvec2> profile, const glm::dvec2& halfSize);

// The solid between two height fields over a rectangle of the xz plane. The fields take (u, v) from
// -1 to 1. `cells`: number of cells along each side.
using Height = std::function<double(double u, double v)>;
Solid slab(const glm::dvec2& low, const glm::dvec2& high, uint32_t cells, const Height& lower,
           const Height& upper);

// A surface without thickness; (u, v) from 0 to 1 become texture coordinates.
using Surface = std::function<glm::dvec3(double u, double v)>;
Solid sheet(uint32_t cellsU, uint32_t cellsV, const Surface& surface);

// Appends a transformed copy of `from` to `to`. The transform must not mirror.
void append(Solid& to, const Solid& from, const glm::dmat4& transform = glm::dmat4(1));

glm::dmat4 moved(const glm::dvec3& by);
glm::dmat4 turned(double turnsAboutY);

// Adds a primitive to the scene and returns its index. Normals are smooth, except across edges
// where the cosine between the face normals is below `creaseCosine`.
uint32_t addPrimitive(Scene& scene, const Solid& solid, uint32_t material, double creaseCosine);

}  // namespace grisaille::scene
