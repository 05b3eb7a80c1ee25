// SPDX-License-Identifier: MIT
// A scene inside Embree, and its triangles in double precision.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/scene/scene.h"
#include "core/trace/alpha_mask.h"
#include "core/trace/embree.h"

namespace grisaille::trace {

struct Triangle {
  uint32_t instance = 0;
  uint32_t firstIndex = 0;  // into Scene::indices

  bool operator==(const Triangle&) const = default;
};

// An instance's transform, relative to the origin.
struct Placement {
  glm::dmat3 linear = glm::dmat3(1);
  glm::dvec3 offset = glm::dvec3(0);
  glm::dmat3 normals = glm::dmat3(1);
  bool mirrored = false;
};

// A triangle relative to the origin.
struct Facet {
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 cross;  // cross product of its edges: its length is twice the area

  // Distance at which a ray meets the facet's plane, in lengths of `direction`, clamped to the
  // range of the corners.
  double crossing(const glm::dvec3& from, const glm::dvec3& direction) const;
};

class TracedScene {
 public:
  // Throws kNoCodecs, kSceneTooLarge. `scene` must outlive this object and change only by
  // scene::pose().
  TracedScene(const scene::Scene& scene, const glm::dvec3& origin);
  ~TracedScene();
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  // Takes the scene's current pose. Returns false if it has it already. Throws kSceneTooLarge.
  bool follow();

  // Holes let every ray through. Back faces block rays, except in queries with a filter that passes
  // undrawn backs, such as passBackFaces().
  RTCScene world() const { return world_; }
  static void passBackFaces(const RTCFilterFunctionNArguments* args);
  // Whether a ray of this direction runs into the back of a single-sided material.
  // geometryUserPtr: that of a filter's arguments
  static bool isUndrawnBack(const void* geometryUserPtr, uint32_t primitive,
                            const glm::dvec3& direction);
  // The same for a triangle of a geometry whose facet is known.
  bool isUndrawnBack(uint32_t geometry, const Triangle& triangle, const Facet& facet,
                     const glm::dvec3& direction) const {
    return !buckets_[geometry].doubleSided && isBack(triangle, facet, direction);
  }

  const scene::Scene& scene() const { return scene_; }
  const glm::dvec3& origin() const { return origin_; }
  const Placement& placement(uint32_t instance) const { return placements_[instance]; }
  const Triangle& triangle(uint32_t geometry, uint32_t primitive) const {
    return buckets_[geometry].triangles[primitive];
  }
  uint32_t materialOf(const Triangle& triangle) const {
    return scene_.primitives[scene_.instances[triangle.instance].primitive].material;
  }
  Facet facet(const Triangle& triangle) const;
  // Whether a ray of this direction runs into the triangle's back.
  bool isBack(const Triangle& triangle, const Facet& facet, const glm::dvec3& direction) const {
    const double facing = glm::dot(facet.cross, direction);
    return placements_[triangle.instance].mirrored ? facing < 0 : facing > 0;
  }
  // Whether the place is a hole of a mask. u, v: weights of the second and the third corner.
  bool isHole(const Triangle& triangle, float u, float v) const;

 private:
  // Triangles with the same mask and sidedness that all move or all stand still: one Embree
  // geometry, with a filter only if they need one.
  struct Bucket {
    const TracedScene* owner = nullptr;
    bool masked = false;
    bool doubleSided = false;
    bool moving = false;
    std::vector<Triangle> triangles;
  };

  void place();
  void loadMasks();
  void sortTriangles();
  void build();
  void attach(uint32_t id, Bucket& bucket);
  void writeVertices(const Bucket& bucket, glm::vec3* vertices) const;
  void throwOnFailure(const char* what) const;
  static void passHoles(const RTCFilterFunctionNArguments* args);

  const scene::Scene& scene_;
  const glm::dvec3 origin_;
  uint64_t poses_ = 0;                           // Scene::poses of the loaded vertices
  std::vector<Placement> placements_;            // one per instance
  std::vector<std::optional<AlphaMask>> masks_;  // one per material; none: not masked
  // Index, and Embree's geomID: masked + 2 * doubleSided + 4 * moving.
  std::array<Bucket, 8> buckets_;
  RTCDevice device_ = nullptr;
  RTCScene world_ = nullptr;
};

}  // namespace grisaille::trace
