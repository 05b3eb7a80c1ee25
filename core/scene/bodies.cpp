// SPDX-License-Identifier: MIT
#include "core/scene/bodies.h"

#include <algorithm>
#include <array>
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
  std::vector<uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t i) {
    return std::array{positions[i].x, positions[i].y, positions[i].z};
  };
  std::ranges::sort(order, [&](uint32_t a, uint32_t b) {
    const auto first = key(a), second = key(b);
    return first != second ? first < second : a < b;
  });
  std::vector<uint32_t> welded(positions.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    welded[order[i]] = same ? welded[order[i - 1]] : order[i];
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

Mesh meshOf(const Scene& scene, const Object& object, const std::vector<uint32_t>& welded) {
  Mesh mesh;
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
  std::ranges::sort(mesh.edges, {}, [](const Edge& edge) {
    return std::array{edge.low, edge.high, edge.triangle};
  });
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

// Sets of triangles that grow together.
class Parts {
 public:
  explicit Parts(size_t triangles) : parent_(triangles) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  uint32_t of(uint32_t triangle) {
    while (parent_[triangle] != triangle) {
      triangle = parent_[triangle] = parent_[parent_[triangle]];
    }
    return triangle;
  }
  void join(uint32_t a, uint32_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<uint32_t> parent_;
};

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

}  // namespace

Matter matterOf(const Scene& scene) {
  const size_t triangles = scene.indices.size() / 3;
  const std::vector<uint32_t> welded = weld(scene.positions);
  std::vector<bool> inPart(triangles), open(triangles);
  std::vector<float> chords(triangles, std::numeric_limits<float>::infinity());
  std::vector<glm::dvec3> areas(scene.primitives.size(), glm::dvec3(0));
  for (const Object& object : objectsOf(scene)) {
    const Mesh mesh = meshOf(scene, object, welded);
    Parts parts(mesh.triangles.size());
    forEachRun(mesh.edges, [&](std::span<const Edge> run) {
      for (const Edge& edge : run) parts.join(edge.triangle, run.front().triangle);
    });
    std::vector<bool> openPart(mesh.triangles.size());
    forEachRun(mesh.edges, [&](std::span<const Edge> run) {
      const auto ascending = std::ranges::count_if(run, &Edge::ascends);
      if (static_cast<size_t>(ascending) * 2 != run.size())
        openPart[parts.of(run.front().triangle)] = true;
    });
    std::vector<Bulk> bulks(mesh.triangles.size());       // by part
    std::map<uint32_t, std::vector<uint32_t>> openParts;  // numbers of their triangles in the scene
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      inPart[mesh.triangles[i]] = true;
      const uint32_t part = parts.of(i);
      bulks[part].add(cornersOf(scene, mesh.triangles[i]));
      if (openPart[part]) openParts[part].push_back(mesh.triangles[i]);
    }
    constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> counted(mesh.triangles.size(), kNone);  // by part: last primitive with it
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const uint32_t part = parts.of(i), primitive = mesh.primitives[i];
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
