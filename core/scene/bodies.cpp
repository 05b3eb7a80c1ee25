// SPDX-License-Identifier: MIT
#include "core/scene/bodies.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <span>

namespace grisaille::scene {
namespace {

// Primitives that stand in the world together, ascending.
using Object = std::vector<uint32_t>;

// The edge of a triangle between two welded vertices, `low` < `high`.
struct Edge {
  uint32_t low, high;
  uint32_t triangle;
  bool ascends;  // runs from `low` to `high`
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

std::vector<Edge> edgesOf(const Scene& scene, const Object& object,
                          const std::vector<uint32_t>& welded) {
  std::vector<Edge> edges;
  for (const uint32_t number : object) {
    const Primitive& primitive = scene.primitives[number];
    if (scene.materials[primitive.material].masked) continue;
    for (uint32_t i = 0; i < primitive.indexCount; i += 3) {
      const uint32_t first = primitive.firstIndex + i;
      std::array<uint32_t, 3> corners;
      for (uint32_t k = 0; k < 3; ++k) corners[k] = welded[scene.indices[first + k]];
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        continue;
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t from = corners[k], to = corners[(k + 1) % 3];
        edges.push_back({std::min(from, to), std::max(from, to), first / 3, from < to});
      }
    }
  }
  std::ranges::sort(edges, {}, [](const Edge& edge) {
    return std::array{edge.low, edge.high, edge.triangle};
  });
  return edges;
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

std::vector<bool> bodyTriangles(const Scene& scene) {
  const size_t triangles = scene.indices.size() / 3;
  const std::vector<uint32_t> welded = weld(scene.positions);
  std::vector<bool> inPart(triangles), open(triangles);
  for (const Object& object : objectsOf(scene)) {
    const std::vector<Edge> edges = edgesOf(scene, object, welded);
    Parts parts(triangles);
    forEachRun(edges, [&](std::span<const Edge> run) {
      for (const Edge& edge : run) parts.join(edge.triangle, run.front().triangle);
    });
    std::vector<bool> openPart(triangles);
    forEachRun(edges, [&](std::span<const Edge> run) {
      const auto ascending = std::ranges::count_if(run, &Edge::ascends);
      if (static_cast<size_t>(ascending) * 2 != run.size())
        openPart[parts.of(run.front().triangle)] = true;
    });
    for (const Edge& edge : edges) {
      inPart[edge.triangle] = true;
      if (openPart[parts.of(edge.triangle)]) open[edge.triangle] = true;
    }
  }
  std::vector<bool> bodies(triangles);
  for (size_t i = 0; i < triangles; ++i) bodies[i] = inPart[i] && !open[i];
  return bodies;
}

}  // namespace grisaille::scene
