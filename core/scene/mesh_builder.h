// SPDX-License-Identifier: MIT
// Solids out of a few generators. Only additions, products, quotients and square roots are used, so
// that every machine makes the same bits.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/scene/scene.h"

namespace grisaille::scene {

// Positions are shared between all triangles that meet there; counter-clockwise is outside.
struct Solid {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> texCoords;  // one a position
  std::vector<uint32_t> indices;
};

using Ring = std::vector<glm::dvec3>;

// Sine and cosine of an angle in turns.
double sinTurns(double turns);
double cosTurns(double turns);

// A number in [0, 1) that depends on the seed alone.
double hashUnit(uint32_t seed);

// Skin over rings of equal size, closed by two caps, or into a loop. Caps must be convex enough to
// be seen whole from their middle.
Solid loft(std::span<const Ring> rings, bool loop);

// `bevel` cuts the upper edges.
Solid box(const glm::dvec3& low, const glm::dvec3& high, double bevel = 0);

// Revolves (radius, height) pairs about the y axis; all radii over 0. `flutes` hollows of the given
// depth, as a share of the radius, run up it.
Solid lathe(std::span<const glm::dvec2> profile, uint32_t segments, uint32_t flutes = 0,
            double depth = 0);

// A moulding round a rectangle about the y axis. The profile is (distance towards the middle,
// height).
Solid frame(std::span<const glm::dvec2> profile, const glm::dvec2& halfSize);

// What lies between two height fields over a rectangle of the xz plane. The fields take (u, v) from
// -1 to 1.
using Height = std::function<double(double u, double v)>;
Solid slab(const glm::dvec2& low, const glm::dvec2& high, uint32_t cells, const Height& lower,
           const Height& upper);

// A surface without thickness; (u, v) from 0 to 1 become texture coordinates.
using Surface = std::function<glm::dvec3(double u, double v)>;
Solid sheet(uint32_t cellsU, uint32_t cellsV, const Surface& surface);

// Adds a transformed copy. The transform must not mirror.
void append(Solid& to, const Solid& from, const glm::dmat4& transform = glm::dmat4(1));

glm::dmat4 moved(const glm::dvec3& by);
glm::dmat4 turned(double turnsAboutY);

// Adds a primitive with normals that are smooth except over edges sharper than the crease, given as
// the cosine between the faces. Returns its index.
uint32_t addPrimitive(Scene& scene, const Solid& solid, uint32_t material, double creaseCosine);

}  // namespace grisaille::scene
