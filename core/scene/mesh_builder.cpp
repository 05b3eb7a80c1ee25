// SPDX-License-Identifier: MIT
#include "core/scene/mesh_builder.h"

#include <array>
#include <cmath>

namespace grisaille::scene {
namespace {

void addTriangle(Solid& solid, size_t a, size_t b, size_t c) {
  for (const size_t i : {a, b, c}) solid.indices.push_back(static_cast<uint32_t>(i));
}

// Adds a cap over the ring of `size` points that starts at `first`. The order of the ring
// determines the winding.
void addCap(Solid& solid, size_t first, size_t size) {
  if (size == 4) {
    addTriangle(solid, first, first + 1, first + 2);
    addTriangle(solid, first, first + 2, first + 3);
    return;
  }
  glm::dvec3 middle(0);
  for (size_t k = 0; k < size; ++k) middle += solid.positions[first + k];
  solid.positions.push_back(middle / static_cast<double>(size));
  for (size_t k = 0; k < size; ++k) {
    addTriangle(solid, solid.positions.size() - 1, first + k, first + (k + 1) % size);
  }
}

void flip(Solid& solid, size_t firstIndex = 0) {
  for (size_t i = firstIndex; i < solid.indices.size(); i += 3) {
    std::swap(solid.indices[i + 1], solid.indices[i + 2]);
  }
}

// Flips a closed solid if its faces point inwards, that is, if its signed volume is negative.
void turnOut(Solid& solid) {
  double volume = 0;
  const glm::dvec3 origin = solid.positions[0];
  for (size_t i = 0; i < solid.indices.size(); i += 3) {
    const auto p = [&](size_t k) { return solid.positions[solid.indices[i + k]] - origin; };
    volume += glm::dot(p(0), glm::cross(p(1), p(2)));
  }
  if (volume < 0) flip(solid);
  solid.texCoords.resize(solid.positions.size(), glm::dvec2(0));
}

}  // namespace

double sinTurns(double turns) {
  double t = turns - std::floor(turns);  // 0 ... 1
  if (t > 0.75) {
    t -= 1;
  } else if (t > 0.25) {
    t = 0.5 - t;
  }
  const double x = t * 6.283185307179586476925;  // -pi/2 ... pi/2
  const double xx = x * x;
  double term = x, sum = x;
  for (int n = 2; n < 20; n += 2) {
    term *= -xx / (n * (n + 1));
    sum += term;
  }
  return sum;
}

double cosTurns(double turns) {
  return sinTurns(turns + 0.25);
}

double hashUnit(uint32_t seed) {
  uint32_t h = seed * 0x9e3779b9u + 0x7f4a7c15u;
  h = (h ^ (h >> 16)) * 0x21f0aaadu;
  h = (h ^ (h >> 15)) * 0x735a2d97u;
  h ^= h >> 15;
  return h / 4294967296.0;
}

Solid loft(std::span<const Ring> rings, bool loop) {
  Solid solid;
  const size_t size = rings[0].size();
  for (const Ring& ring : rings) {
    solid.positions.insert(solid.positions.end(), ring.begin(), ring.end());
  }
  const size_t spans = loop ? rings.size() : rings.size() - 1;
  for (size_t i = 0; i < spans; ++i) {
    const size_t from = i * size, to = (i + 1) % rings.size() * size;
    for (size_t k = 0; k < size; ++k) {
      const size_t next = (k + 1) % size;
      addTriangle(solid, from + k, from + next, to + next);
      addTriangle(solid, from + k, to + next, to + k);
    }
  }
  if (!loop) {
    const size_t firstIndex = solid.indices.size();
    addCap(solid, 0, size);
    flip(solid, firstIndex);  // only the first cap exists yet
    addCap(solid, (rings.size() - 1) * size, size);
  }
  turnOut(solid);
  return solid;
}

Solid box(const glm::dvec3& low, const glm::dvec3& high, double bevel) {
  const auto ring = [&](double y, double inset) -> Ring {
    const glm::dvec2 a(low.x + inset, low.z + inset), b(high.x - inset, high.z - inset);
    return {{a.x, y, b.y}, {b.x, y, b.y}, {b.x, y, a.y}, {a.x, y, a.y}};
  };
  if (bevel <= 0) return loft(std::array{ring(low.y, 0), ring(high.y, 0)}, false);
  return loft(std::array{ring(low.y, 0), ring(high.y - bevel, 0), ring(high.y, bevel)}, false);
}

Solid lathe(std::span<const glm::dvec2> profile, uint32_t segments, uint32_t flutes, double depth) {
  std::vector<Ring> rings;
  for (const glm::dvec2& point : profile) {
    Ring& ring = rings.emplace_back();
    for (uint32_t k = 0; k < segments; ++k) {
      const double turn = static_cast<double>(k) / segments;
      double radius = point.x;
      if (flutes > 0) {
        const double within = turn * flutes - std::floor(turn * flutes);  // 0: edge of a flute
        radius *= 1 - depth * sinTurns(within / 2);
      }
      ring.emplace_back(radius * cosTurns(turn), point.y, -radius * sinTurns(turn));
    }
  }
  return loft(rings, false);
}

Solid frame(std::span<const glm::dvec2> profile, const glm::dvec2& halfSize) {
  std::vector<Ring> rings;
  for (const glm::dvec2& corner :
       {glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1), glm::dvec2(-1, 1)}) {
    Ring& ring = rings.emplace_back();
    for (const glm::dvec2& point : profile) {
      const glm::dvec2 at = corner * (halfSize - point.x);
      ring.emplace_back(at.x, point.y, at.y);
    }
  }
  return loft(rings, true);
}

Solid slab(const glm::dvec2& low, const glm::dvec2& high, uint32_t cells, const Height& lower,
           const Height& upper) {
  Solid solid;
  const uint32_t side = cells + 1, layer = side * side;
  for (const Height* height : {&lower, &upper}) {
    for (uint32_t j = 0; j < side; ++j) {
      for (uint32_t i = 0; i < side; ++i) {
        const glm::dvec2 at = glm::dvec2(i, j) / static_cast<double>(cells);
        const glm::dvec2 p = low + (high - low) * at;
        solid.positions.emplace_back(p.x, (*height)(2 * at.x - 1, 2 * at.y - 1), p.y);
      }
    }
  }
  for (uint32_t j = 0; j < cells; ++j) {
    for (uint32_t i = 0; i < cells; ++i) {
      const uint32_t a = j * side + i, b = a + 1, c = a + side + 1, d = a + side;
      // Splits cells along the diagonals of the rectangle, where vaults have their groins.
      const bool main = (2 * i < cells) == (2 * j < cells);
      for (const uint32_t up : {0u, layer}) {
        const size_t firstIndex = solid.indices.size();
        addTriangle(solid, up + a, up + b, up + (main ? c : d));
        addTriangle(solid, up + (main ? a : b), up + c, up + d);
        if (up != 0) flip(solid, firstIndex);
      }
    }
  }
  const auto wall = [&](uint32_t from, uint32_t to) {
    addTriangle(solid, to, from, layer + from);
    addTriangle(solid, to, layer + from, layer + to);
  };
  for (uint32_t k = 0; k < cells; ++k) {
    wall(k, k + 1);
    wall(k * side + cells, (k + 1) * side + cells);
    wall(layer - 1 - k, layer - 2 - k);
    wall((cells - k) * side, (cells - k - 1) * side);
  }
  turnOut(solid);
  return solid;
}

Solid sheet(uint32_t cellsU, uint32_t cellsV, const Surface& surface) {
  Solid solid;
  for (uint32_t j = 0; j <= cellsV; ++j) {
    for (uint32_t i = 0; i <= cellsU; ++i) {
      const glm::dvec2 at(static_cast<double>(i) / cellsU, static_cast<double>(j) / cellsV);
      solid.positions.push_back(surface(at.x, at.y));
      solid.texCoords.push_back(at);
    }
  }
  for (uint32_t j = 0; j < cellsV; ++j) {
    for (uint32_t i = 0; i < cellsU; ++i) {
      const uint32_t a = j * (cellsU + 1) + i, b = a + cellsU + 1;
      addTriangle(solid, a, b, b + 1);
      addTriangle(solid, a, b + 1, a + 1);
    }
  }
  return solid;
}

void append(Solid& to, const Solid& from, const glm::dmat4& transform) {
  const auto base = static_cast<uint32_t>(to.positions.size());
  for (const glm::dvec3& p : from.positions) {
    to.positions.emplace_back(transform * glm::dvec4(p, 1));
  }
  to.texCoords.insert(to.texCoords.end(), from.texCoords.begin(), from.texCoords.end());
  for (const uint32_t index : from.indices) to.indices.push_back(base + index);
}

glm::dmat4 moved(const glm::dvec3& by) {
  glm::dmat4 matrix(1);
  matrix[3] = glm::dvec4(by, 1);
  return matrix;
}

glm::dmat4 turned(double turnsAboutY) {
  const double c = cosTurns(turnsAboutY), s = sinTurns(turnsAboutY);
  glm::dmat4 matrix(1);
  matrix[0] = {c, 0, -s, 0};
  matrix[2] = {s, 0, c, 0};
  return matrix;
}

uint32_t addPrimitive(Scene& scene, const Solid& solid, uint32_t material, double creaseCosine) {
  const size_t corners = solid.indices.size();
  std::vector<glm::dvec3> faces(corners / 3);  // normals, with twice the area as length
  std::vector<std::vector<uint32_t>> cornersAt(solid.positions.size());
  for (size_t i = 0; i < corners; ++i) {
    cornersAt[solid.indices[i]].push_back(static_cast<uint32_t>(i));
    if (i % 3 != 0) continue;
    const auto p = [&](size_t k) { return solid.positions[solid.indices[i + k]]; };
    faces[i / 3] = glm::cross(p(1) - p(0), p(2) - p(0));
  }
  const auto first = static_cast<uint32_t>(scene.indices.size());
  scene.indices.resize(first + corners);
  for (size_t vertex = 0; vertex < cornersAt.size(); ++vertex) {
    // Corners with equal normals share one vertex of the scene.
    std::vector<std::pair<glm::vec3, uint32_t>> made;
    for (const uint32_t corner : cornersAt[vertex]) {
      const glm::dvec3 own = faces[corner / 3];
      glm::dvec3 sum(0);
      for (const uint32_t other : cornersAt[vertex]) {
        const glm::dvec3& face = faces[other / 3];
        const double limit = creaseCosine * std::sqrt(glm::dot(own, own) * glm::dot(face, face));
        if (glm::dot(own, face) >= limit) sum += face;
      }
      const glm::vec3 normal(sum / std::sqrt(glm::dot(sum, sum)));
      uint32_t index = static_cast<uint32_t>(scene.positions.size());
      for (const auto& [known, at] : made) {
        if (known == normal) index = at;
      }
      if (index == scene.positions.size()) {
        made.emplace_back(normal, index);
        scene.positions.emplace_back(solid.positions[vertex]);
        scene.normals.push_back(normal);
        scene.texCoords.emplace_back(solid.texCoords[vertex]);
      }
      scene.indices[first + corner] = index;
    }
  }
  scene.primitives.push_back(
      {.firstIndex = first, .indexCount = static_cast<uint32_t>(corners), .material = material});
  return static_cast<uint32_t>(scene.primitives.size() - 1);
}

}  // namespace grisaille::scene
