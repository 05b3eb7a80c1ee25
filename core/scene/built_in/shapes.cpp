// SPDX-License-Identifier: MIT
#include "core/scene/built_in/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grisaille::scene {
namespace {

// A unit vector across `direction`.
glm::dvec3 across(const glm::dvec3& direction) {
  const glm::dvec3 a = glm::abs(direction);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                          : a.z <= a.y             ? glm::dvec3(0, 0, 1)
                                                   : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, direction));
}

glm::dvec3 tangentAt(const Path& path, size_t i, bool loop) {
  const size_t last = path.size() - 1;
  const size_t before = i > 0 ? i - 1 : loop ? last : 0;
  const size_t after = i < last ? i + 1 : loop ? 0 : last;
  const glm::dvec3 in = path[i] - path[before], out = path[after] - path[i];
  const auto unit = [](const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
  };
  return glm::normalize(unit(in) + unit(out));
}

// The rings of a section along a path.
std::vector<Ring> ringsAlong(std::span<const glm::dvec2> section, const Path& path, glm::dvec3 up,
                             std::span<const double> scale, bool loop) {
  std::vector<Ring> rings;
  for (size_t i = 0; i < path.size(); ++i) {
    const glm::dvec3 tangent = tangentAt(path, i, loop);
    up = glm::normalize(up - glm::dot(up, tangent) * tangent);
    const glm::dvec3 side = glm::cross(tangent, up);
    const double size = scale.empty() ? 1 : scale[i];
    Ring& ring = rings.emplace_back();
    for (const glm::dvec2& p : section) ring.push_back(path[i] + size * (p.x * side + p.y * up));
  }
  return rings;
}

std::vector<glm::dvec2> circle(uint32_t sides) {
  std::vector<glm::dvec2> points;
  for (uint32_t k = 0; k < sides; ++k) {
    const double turn = static_cast<double>(k) / sides;
    points.emplace_back(cosTurns(turn), sinTurns(turn));
  }
  return points;
}

// Appends a quadrilateral as two triangles.
void addQuad(Solid& solid, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  solid.indices.insert(solid.indices.end(), {a, b, c, a, c, d});
}

uint32_t addPoint(Solid& solid, const glm::dvec3& point) {
  solid.positions.push_back(point);
  solid.texCoords.emplace_back(0);
  return static_cast<uint32_t>(solid.positions.size() - 1);
}

// Closes a solid whose front has the border `rim`, in counter-clockwise order seen from the front:
// walls back to points moved by `back`, and a flat fan.
void closeBehind(Solid& solid, const std::vector<uint32_t>& rim,
                 const std::function<glm::dvec3(const glm::dvec3&)>& back) {
  std::vector<uint32_t> behind;
  glm::dvec3 sum(0);
  for (const uint32_t point : rim) {
    behind.push_back(addPoint(solid, back(solid.positions[point])));
    sum += solid.positions.back();
  }
  const uint32_t middle = addPoint(solid, sum / static_cast<double>(rim.size()));
  for (size_t k = 0; k < rim.size(); ++k) {
    const size_t next = (k + 1) % rim.size();
    addQuad(solid, rim[next], rim[k], behind[k], behind[next]);
    solid.indices.insert(solid.indices.end(), {middle, behind[next], behind[k]});
  }
}

// The border of a grid of (columns + 1) x (rows + 1) points, counter-clockwise where columns run
// right and rows up.
std::vector<uint32_t> rimOf(uint32_t columns, uint32_t rows) {
  const uint32_t row = columns + 1;
  std::vector<uint32_t> rim;
  for (uint32_t i = 0; i < columns; ++i) rim.push_back(i);
  for (uint32_t j = 0; j < rows; ++j) rim.push_back(j * row + columns);
  for (uint32_t i = columns; i > 0; --i) rim.push_back(rows * row + i);
  for (uint32_t j = rows; j > 0; --j) rim.push_back(j * row);
  return rim;
}

}  // namespace

double smoothUnit(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double hashBetween(uint32_t seed, double low, double high) {
  return low + (high - low) * hashUnit(seed);
}

double noise(double x, double y, uint32_t seed) {
  const double column = std::floor(x), row = std::floor(y);
  const auto at = [&](int i, int j) {
    const auto p = static_cast<uint32_t>(static_cast<int>(column) + i + 4096);
    const auto q = static_cast<uint32_t>(static_cast<int>(row) + j + 4096);
    return 2 * hashUnit(seed * 7919u + p * 8192u + q) - 1;
  };
  const double u = smoothUnit(x - column), v = smoothUnit(y - row);
  const double low = at(0, 0) + (at(1, 0) - at(0, 0)) * u;
  const double high = at(0, 1) + (at(1, 1) - at(0, 1)) * u;
  return low + (high - low) * v;
}

glm::dmat4 turnedX(double turns) {
  const double c = cosTurns(turns), s = sinTurns(turns);
  glm::dmat4 matrix(1);
  matrix[1] = {0, c, s, 0};
  matrix[2] = {0, -s, c, 0};
  return matrix;
}

glm::dmat4 turnedZ(double turns) {
  const double c = cosTurns(turns), s = sinTurns(turns);
  glm::dmat4 matrix(1);
  matrix[0] = {c, s, 0, 0};
  matrix[1] = {-s, c, 0, 0};
  return matrix;
}

glm::dmat4 scaled(const glm::dvec3& by) {
  glm::dmat4 matrix(1);
  for (int i = 0; i < 3; ++i) matrix[i][i] = by[i];
  return matrix;
}

glm::dmat4 aimed(const glm::dvec3& from, const glm::dvec3& direction) {
  const glm::dvec3 y = glm::normalize(direction), x = across(y), z = glm::cross(x, y);
  glm::dmat4 matrix(1);
  matrix[0] = glm::dvec4(x, 0);
  matrix[1] = glm::dvec4(y, 0);
  matrix[2] = glm::dvec4(z, 0);
  matrix[3] = glm::dvec4(from, 1);
  return matrix;
}

Path curve(std::span<const glm::dvec3> points, uint32_t steps) {
  Path path;
  const size_t last = points.size() - 1;
  for (size_t i = 0; i < last; ++i) {
    const glm::dvec3 a = points[i > 0 ? i - 1 : 0], b = points[i], c = points[i + 1],
                     d = points[std::min(i + 2, last)];
    for (uint32_t k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      path.push_back(0.5 * (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                            t * t * t * (3.0 * b - a - 3.0 * c + d)));
    }
  }
  path.push_back(points[last]);
  return path;
}

Path bent(std::span<const glm::dvec3> points, double radius, uint32_t steps) {
  Path path{points[0]};
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const glm::dvec3 corner = points[i];
    const glm::dvec3 from = corner + radius * glm::normalize(points[i - 1] - corner);
    const glm::dvec3 to = corner + radius * glm::normalize(points[i + 1] - corner);
    for (uint32_t k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      path.push_back((1 - t) * (1 - t) * from + 2 * t * (1 - t) * corner + t * t * to);
    }
  }
  path.push_back(points.back());
  return path;
}

Path hanging(const glm::dvec3& from, const glm::dvec3& to, double sag, uint32_t steps) {
  Path path;
  for (uint32_t k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    path.push_back(from + t * (to - from) - glm::dvec3(0, 4 * sag * t * (1 - t), 0));
  }
  return path;
}

Solid sweep(std::span<const glm::dvec2> section, const Path& path, const glm::dvec3& up,
            std::span<const double> scale) {
  return loft(ringsAlong(section, path, up, scale, false), false);
}

Solid tube(const Path& path, std::span<const double> radii, uint32_t sides) {
  const std::vector<double> sizes = radii.size() == 1
                                        ? std::vector<double>(path.size(), radii[0])
                                        : std::vector<double>(radii.begin(), radii.end());
  return sweep(circle(sides), path, across(tangentAt(path, 0, false)), sizes);
}

Solid tube(const Path& path, double radius, uint32_t sides) {
  return tube(path, std::array{radius}, sides);
}

Solid hoop(const Path& path, double radius, uint32_t sides) {
  glm::dvec3 normal(0);
  for (size_t i = 0; i < path.size(); ++i) {
    normal += glm::cross(path[i] - path[0], path[(i + 1) % path.size()] - path[0]);
  }
  const std::vector<double> sizes(path.size(), radius);
  return loft(ringsAlong(circle(sides), path, glm::normalize(normal), sizes, true), true);
}

Solid torus(double radius, double thickness, uint32_t segments, uint32_t sides) {
  Path path;
  for (uint32_t k = 0; k < segments; ++k) {
    const double turn = static_cast<double>(k) / segments;
    path.emplace_back(radius * cosTurns(turn), 0, radius * sinTurns(turn));
  }
  return hoop(path, thickness, sides);
}

Solid ball(double radius, uint32_t segments, uint32_t rows) {
  std::vector<glm::dvec2> profile;
  for (uint32_t k = 1; k < rows; ++k) {
    const double turn = 0.5 * k / rows;
    profile.emplace_back(radius * sinTurns(turn), -radius * cosTurns(turn));
  }
  Solid solid = lathe(profile, segments);
  // The middles of the two caps become the poles.
  const size_t count = solid.positions.size();
  if (segments != 4) {
    solid.positions[count - 2].y = -radius;
    solid.positions[count - 1].y = radius;
  }
  return solid;
}

Solid block(const glm::dvec3& low, const glm::dvec3& high, double bevel) {
  Solid solid;
  const glm::dvec3 middle = 0.5 * (low + high);
  // The point of a corner (bit i: the high side of axis i) that lies in the face across `axis`.
  const auto point = [](uint32_t corner, uint32_t axis) { return corner * 3 + axis; };
  for (uint32_t corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 p;
      for (int i = 0; i < 3; ++i) {
        const bool up = (corner >> i & 1) != 0;
        p[i] = (up ? high : low)[i] + (i == axis ? 0 : up ? -bevel : bevel);
      }
      addPoint(solid, p);
    }
  }
  const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
    const auto at = [&](uint32_t i) { return solid.positions[i]; };
    const bool out = glm::dot(glm::cross(at(b) - at(a), at(c) - at(a)), at(a) - middle) > 0;
    solid.indices.insert(solid.indices.end(), {a, out ? b : c, out ? c : b});
  };
  const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  };
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    for (const uint32_t side : {0u, 1u << axis}) {
      quad(point(side, axis), point(side | u, axis), point(side | u | v, axis),
           point(side | v, axis));
    }
    // The bevels of the four edges along this axis.
    const uint32_t along = 1u << axis, first = (axis + 1) % 3, second = (axis + 2) % 3;
    for (const uint32_t edge : {0u, u, v, u | v}) {
      quad(point(edge, first), point(edge | along, first), point(edge | along, second),
           point(edge, second));
    }
  }
  for (uint32_t corner = 0; corner < 8; ++corner) {
    triangle(point(corner, 0), point(corner, 1), point(corner, 2));
  }
  return solid;
}

Solid prism(std::span<const glm::dvec2> outline, double low, double high, double bevel) {
  glm::dvec2 middle(0);
  for (const glm::dvec2& p : outline) middle += p / static_cast<double>(outline.size());
  const auto ring = [&](double y, double inset) {
    Ring points;
    for (const glm::dvec2& p : outline) {
      const glm::dvec2 at = p - inset * glm::normalize(p - middle);
      points.emplace_back(at.x, y, at.y);
    }
    return points;
  };
  if (bevel <= 0) return loft(std::array{ring(low, 0), ring(high, 0)}, false);
  return loft(std::array{ring(low, 0), ring(high - bevel, 0), ring(high, bevel)}, false);
}

Solid ground(const glm::dvec2& low, const glm::dvec2& high, const glm::uvec2& cells, double bottom,
             const std::function<double(double x, double z)>& height) {
  Solid solid;
  const uint32_t row = cells.x + 1;
  for (uint32_t j = 0; j <= cells.y; ++j) {
    for (uint32_t i = 0; i <= cells.x; ++i) {
      // Rows run to -z, so that columns and rows are counter-clockwise from above.
      const double x = low.x + (high.x - low.x) * i / cells.x;
      const double z = high.y - (high.y - low.y) * j / cells.y;
      addPoint(solid, {x, height(x, z), z});
    }
  }
  for (uint32_t j = 0; j < cells.y; ++j) {
    for (uint32_t i = 0; i < cells.x; ++i) {
      const uint32_t a = j * row + i, b = a + 1, c = b + row, d = a + row;
      if ((i + j) % 2 == 0) {
        addQuad(solid, a, b, c, d);
      } else {
        addQuad(solid, b, c, d, a);
      }
    }
  }
  closeBehind(solid, rimOf(cells.x, cells.y),
              [&](const glm::dvec3& p) { return glm::dvec3(p.x, bottom, p.z); });
  return solid;
}

Solid recessedWall(std::span<const double> xs, std::span<const double> ys,
                   const std::function<double(uint32_t column, uint32_t row)>& depth,
                   double thickness) {
  Solid solid;
  const auto row = static_cast<uint32_t>(xs.size());
  const auto columns = static_cast<uint32_t>(xs.size() - 1);
  const auto rows = static_cast<uint32_t>(ys.size() - 1);
  for (const double y : ys) {
    for (const double x : xs) addPoint(solid, {x, y, 0});
  }
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t a = j * row + i;
      const std::array edge{a, a + 1, a + 1 + row, a + row};
      const double deep = depth(i, j);
      if (deep <= 0) {
        addQuad(solid, edge[0], edge[1], edge[2], edge[3]);
        continue;
      }
      std::array<uint32_t, 4> floor{};
      for (uint32_t k = 0; k < 4; ++k) {
        floor[k] = addPoint(solid, solid.positions[edge[k]] - glm::dvec3(0, 0, deep));
      }
      addQuad(solid, floor[0], floor[1], floor[2], floor[3]);
      for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t next = (k + 1) % 4;
        addQuad(solid, edge[k], edge[next], floor[next], floor[k]);
      }
    }
  }
  closeBehind(solid, rimOf(columns, rows),
              [&](const glm::dvec3& p) { return p - glm::dvec3(0, 0, thickness); });
  return solid;
}

}  // namespace grisaille::scene
