// SPDX-License-Identifier: MIT
#include "core/scene/bodies.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace grisaille::scene {
namespace {

// Primitives that stand in the world together, ascending.
using Object = std::vector<uint32_t>;

// The edge of a triangle between two welded vertices, `low` < `high`.
struct Edge {
  uint32_t low, high;
  uint32_t triangle;  // index into Mesh::triangles
  bool ascends;       // runs from `low` to `high`
};

// The triangles of an object that count, and their edges, in the order of their vertices.
struct Mesh {
  std::vector<uint32_t> triangles;   // numbers in the scene
  std::vector<uint32_t> primitives;  // that of each
  std::vector<Edge> edges;
};

// For each vertex, the lowest vertex at the same position.
std::vector<uint32_t> weld(const std::vector<glm::vec3>& positions) {
  constexpr uint32_t kFree = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> table(std::bit_ceil(2 * positions.size() + 1), kFree);
  const size_t mask = table.size() - 1;
  std::vector<uint32_t> welded(positions.size());
  for (uint32_t i = 0; i < positions.size(); ++i) {
    size_t slot = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float coordinate = positions[i][axis] + 0.0f;  // 0 and -0 are equal
      slot = (slot ^ std::bit_cast<uint32_t>(coordinate)) * 0x9e3779b97f4a7c15;
      slot ^= slot >> 32;
    }
    slot &= mask;
    while (table[slot] != kFree && positions[table[slot]] != positions[i]) slot = (slot + 1) & mask;
    if (table[slot] == kFree) table[slot] = i;
    welded[i] = table[slot];
  }
  return welded;
}

// The sets of primitives whose instances have equal transforms; each set once.
std::set<Object> objectsOf(const Scene& scene) {
  using Transform = std::array<double, 16>;
  std::map<Transform, std::set<uint32_t>> places;
  for (const Instance& instance : scene.instances) {
    Transform transform;
    std::memcpy(transform.data(), &instance.worldFromObject, sizeof(transform));
    places[transform].insert(instance.primitive);
  }
  std::set<Object> objects;
  for (const auto& [transform, primitives] : places) {
    objects.emplace(primitives.begin(), primitives.end());
  }
  return objects;
}

// Edges in the order of their vertices, `low` first. Those of the same vertices keep their order.
std::vector<Edge> ordered(const std::vector<Edge>& edges, size_t vertices) {
  std::vector<size_t> starts(vertices + 1);  // of each `low`
  for (const Edge& edge : edges) ++starts[edge.low + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Edge> sorted(edges.size());
  std::vector<size_t> next = starts;
  for (const Edge& edge : edges) sorted[next[edge.low]++] = edge;
  for (size_t low = 0; low < vertices; ++low) {
    const auto begin = sorted.begin() + static_cast<ptrdiff_t>(starts[low]);
    const auto end = sorted.begin() + static_cast<ptrdiff_t>(starts[low + 1]);
    std::sort(begin, end, [](const Edge& a, const Edge& b) {
      return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
    });
  }
  return sorted;
}

Mesh meshOf(const Scene& scene, const Object& object, const std::vector<uint32_t>& welded) {
  Mesh mesh;
  size_t most = 0;  // triangles
  for (const uint32_t number : object) most += scene.primitives[number].indexCount / 3;
  mesh.triangles.reserve(most);
  mesh.primitives.reserve(most);
  mesh.edges.reserve(3 * most);
  for (const uint32_t number : object) {
    const Primitive& primitive = scene.primitives[number];
    if (scene.materials[primitive.material].masked) continue;
    for (uint32_t i = 0; i < primitive.indexCount; i += 3) {
      const uint32_t first = primitive.firstIndex + i;
      std::array<uint32_t, 3> corners;
      for (uint32_t k = 0; k < 3; ++k) corners[k] = welded[scene.indices[first + k]];
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        continue;
      const auto triangle = static_cast<uint32_t>(mesh.triangles.size());
      mesh.triangles.push_back(first / 3);
      mesh.primitives.push_back(number);
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t from = corners[k], to = corners[(k + 1) % 3];
        mesh.edges.push_back({std::min(from, to), std::max(from, to), triangle, from < to});
      }
    }
  }
  mesh.edges = ordered(mesh.edges, welded.size());
  return mesh;
}

// A triangle of a part.
struct Corners {
  glm::dvec3 a, b, c;
};

Corners cornersOf(const Scene& scene, uint32_t triangle) {
  const auto at = [&](uint32_t k) {
    return glm::dvec3(scene.positions[scene.indices[size_t{triangle} * 3 + k]]);
  };
  return {at(0), at(1), at(2)};
}

std::vector<Corners> cornersOf(const Scene& scene, const std::vector<uint32_t>& triangles) {
  std::vector<Corners> corners;
  for (const uint32_t triangle : triangles) corners.push_back(cornersOf(scene, triangle));
  return corners;
}

// Surface and volume of a part, relative to a corner of it.
struct Bulk {
  std::optional<glm::dvec3> origin;
  double area = 0, volume = 0;
  glm::dvec3 areas{0};                 // see Matter::areas
  glm::dvec3 centre{0}, direction{0};  // sums of centroids by area, and of directed areas

  void add(const Corners& t) {
    if (!origin) origin = t.a;
    const glm::dvec3 a = t.a - *origin, b = t.b - *origin, c = t.c - *origin;
    const glm::dvec3 directed = glm::cross(b - a, c - a) / 2.0;
    const double own = glm::length(directed);
    area += own;
    if (own > 0) areas += directed * directed / own;
    centre += own * (a + b + c) / 3.0;
    volume += glm::dot(a, directed) / 3;
    direction += directed;
  }
  // Where the part is open, its volume is that of the cones from its surface to its centroid.
  double meanChord() const {
    if (!(area > 0)) return 0;
    return 4 * std::abs(volume - glm::dot(centre, direction) / (3 * area)) / area;
  }
};

// The solid angle of a triangle from a point, over 4 pi: van Oosterom and Strackee, "The Solid
// Angle of a Plane Triangle", IEEE Transactions on Biomedical Engineering 30(2), 1983, equation 8.
// Positive if the point is on the inner side.
double solidAngle(const Corners& t, const glm::dvec3& point) {
  const glm::dvec3 a = t.a - point, b = t.b - point, c = t.c - point;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double over = glm::dot(a, glm::cross(b, c));
  const double under =
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return std::atan2(over, under) / (2 * std::numbers::pi);
}

// Whether a part that is not closed encloses matter all the same.
bool enclosesMatter(const std::vector<Corners>& part) {
  constexpr size_t kPoints = 16;
  constexpr double kLeast = 0.65;
  constexpr double kBelow = 1e-6;  // of the part's size, to leave the triangle itself
  std::vector<double> areas;       // twice the area of the triangles up to each
  double area = 0;
  glm::dvec3 least = part.front().a, most = least;
  for (const Corners& t : part) {
    areas.push_back(area += glm::length(glm::cross(t.b - t.a, t.c - t.a)));
    least = glm::min(least, glm::min(t.a, glm::min(t.b, t.c)));
    most = glm::max(most, glm::max(t.a, glm::max(t.b, t.c)));
  }
  if (!(area > 0)) return false;
  double sum = 0;
  for (size_t k = 0; k < kPoints; ++k) {
    // Points that share the area evenly.
    const double wanted = (static_cast<double>(k) + 0.5) / kPoints * area;
    const auto found = std::ranges::lower_bound(areas, wanted);
    const Corners& t = part[static_cast<size_t>(found - areas.begin())];
    const glm::dvec3 normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
    const glm::dvec3 point = (t.a + t.b + t.c) / 3.0 - kBelow * glm::length(most - least) * normal;
    for (const Corners& other : part) sum += solidAngle(other, point);
  }
  return sum >= kLeast * kPoints;
}

// Calls `use` for each run of edges between the same vertices.
template <typename Use>
void forEachRun(const std::vector<Edge>& edges, Use&& use) {
  for (size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end].low == edges[first].low &&
           edges[end].high == edges[first].high) {
      ++end;
    }
    use(std::span(edges).subspan(first, end - first));
  }
}

// The parts of a mesh, numbered in the order of their first triangles.
struct Parts {
  std::vector<uint32_t> of;  // that of each triangle
  uint32_t count = 0;
};

// Triangles that share an edge belong together.
Parts partsOf(const Mesh& mesh) {
  std::vector<uint32_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t triangle) {
    while (parent[triangle] != triangle) {
      triangle = parent[triangle] = parent[parent[triangle]];
    }
    return triangle;
  };
  forEachRun(mesh.edges, [&](std::span<const Edge> run) {
    for (const Edge& edge : run) {
      const uint32_t a = root(edge.triangle), b = root(run.front().triangle);
      parent[std::max(a, b)] = std::min(a, b);
    }
  });
  // A root comes before the other triangles of its part.
  Parts parts{.of = std::vector<uint32_t>(mesh.triangles.size())};
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const uint32_t own = root(i);
    parts.of[i] = own == i ? parts.count++ : parts.of[own];
  }
  return parts;
}

}  // namespace

Matter matterOf(const Scene& scene) {
  const size_t triangles = scene.indices.size() / 3;
  const std::vector<uint32_t> welded = weld(scene.positions);
  std::vector<bool> inPart(triangles), open(triangles);
  std::vector<float> chords(triangles, std::numeric_limits<float>::infinity());
  std::vector<glm::dvec3> areas(scene.primitives.size(), glm::dvec3(0));
  for (const Object& object : objectsOf(scene)) {
    const Mesh mesh = meshOf(scene, object, welded);
    const Parts parts = partsOf(mesh);
    std::vector<bool> openPart(parts.count);
    forEachRun(mesh.edges, [&](std::span<const Edge> run) {
      const auto ascending = std::ranges::count_if(run, &Edge::ascends);
      if (static_cast<size_t>(ascending) * 2 != run.size())
        openPart[parts.of[run.front().triangle]] = true;
    });
    std::vector<Bulk> bulks(parts.count);
    std::map<uint32_t, std::vector<uint32_t>> openParts;  // numbers of their triangles in the scene
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      inPart[mesh.triangles[i]] = true;
      const uint32_t part = parts.of[i];
      bulks[part].add(cornersOf(scene, mesh.triangles[i]));
      if (openPart[part]) openParts[part].push_back(mesh.triangles[i]);
    }
    constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> counted(parts.count, kNone);  // by part: last primitive with it
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const uint32_t part = parts.of[i], primitive = mesh.primitives[i];
      float& chord = chords[mesh.triangles[i]];
      chord = std::min(chord, static_cast<float>(bulks[part].meanChord()));
      if (std::exchange(counted[part], primitive) != primitive) {
        areas[primitive] += bulks[part].areas;
      }
    }
    for (const auto& [part, all] : openParts) {
      if (enclosesMatter(cornersOf(scene, all))) continue;
      for (const uint32_t triangle : all) open[triangle] = true;
    }
  }
  Matter matter{.bodies = std::vector<bool>(triangles),
                .thickness = std::move(chords),
                .areas = std::move(areas)};
  for (const Primitive& primitive : scene.primitives) {
    const Material& material = scene.materials[primitive.material];
    const float other = material.doubleSided || material.masked ? 0.0f : -1.0f;
    for (size_t i = primitive.firstIndex / 3; i < (primitive.firstIndex + primitive.indexCount) / 3;
         ++i) {
      matter.bodies[i] = inPart[i] && !open[i];
      if (!matter.bodies[i]) matter.thickness[i] = other;
    }
  }
  return matter;
}

double chordScale(const glm::dvec3& areas, const glm::dmat3& linear) {
  // An area across an axis becomes the parallelogram of the other two axes' images.
  const glm::dvec3 factors(glm::length(glm::cross(linear[1], linear[2])),
                           glm::length(glm::cross(linear[2], linear[0])),
                           glm::length(glm::cross(linear[0], linear[1])));
  const double before = areas.x + areas.y + areas.z, after = glm::dot(areas, factors);
  return after > 0 ? std::abs(glm::determinant(linear)) * before / after : 0;
}

std::vector<float> vertexThickness(const Scene& scene, const Matter& matter) {
  std::vector<float> thickness(scene.positions.size(), -1.0f);
  for (size_t i = 0; i < scene.indices.size(); ++i) {
    thickness[scene.indices[i]] = matter.thickness[i / 3];
  }
  return thickness;
}

}  // namespace grisaille::scene
