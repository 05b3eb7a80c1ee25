// SPDX-License-Identifier: MIT
#include "core/trace/buried.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/trace/parallel.h"
#include "core/trace/sampling.h"
#include "core/trace/traced_scene.h"

namespace grisaille::trace {
namespace {

constexpr uint32_t kPlaces = 16, kRays = 2;  // on a triangle; from each place
constexpr uint32_t kMostFar = kPlaces * kRays / 4;
constexpr double kFar = 0.2;  // diagonals of the scene

class Burial {
 public:
  explicit Burial(const TracedScene& traced) : traced_(traced) {
    RTCBounds b = {};
    rtcGetSceneBounds(traced.world(), &b);
    const glm::dvec3 least(b.lower_x, b.lower_y, b.lower_z), most(b.upper_x, b.upper_y, b.upper_z);
    lift_ = 4e-6 * glm::length(glm::max(glm::abs(least), glm::abs(most)));
    far_ = static_cast<float>(kFar * glm::length(most - least));
  }

  bool isBuried(const Triangle& triangle, bool bothSides) const {
    const Facet facet = traced_.facet(triangle);
    const double length = glm::length(facet.cross);
    if (!(length > 0)) return true;  // draws nothing
    const bool mirrored = traced_.placement(triangle.instance).mirrored;
    const glm::dvec3 normal = facet.cross * ((mirrored ? -1.0 : 1.0) / length);
    return isBelow(facet, normal) && (!bothSides || isBelow(facet, -normal));
  }

 private:
  // Whether a side of the triangle is buried.
  bool isBelow(const Facet& facet, const glm::dvec3& normal) const {
    const glm::mat3 frame = frameAbout(glm::vec3(normal));
    const auto& [a, b, c] = facet.corners;
    uint32_t far = 0;
    for (uint32_t i = 0; i < kPlaces; ++i) {
      const glm::vec2 unit = sobolPoint(i, 1);
      const double root = std::sqrt(unit.x);
      const glm::dvec3 place =
          a + root * (1.0 - unit.y) * (b - a) + root * unit.y * (c - a) + lift_ * normal;
      for (uint32_t k = 0; k < kRays; ++k) {
        const glm::vec3 way = frame * cosineDirection(sobolPoint(kRays * i + k, 2));
        const Met what = met(glm::vec3(place), way);
        far += what == Met::kFarBack ? 1 : 0;
        if (what == Met::kSkyOrFront || far > kMostFar) return false;
      }
    }
    return true;
  }

  // What a ray meets.
  enum class Met : uint8_t { kSkyOrFront, kNearBack, kFarBack };
  Met met(const glm::vec3& from, const glm::vec3& way) const {
    RTCRayHit ray = embree::makeRay(from, way, 0, std::numeric_limits<float>::infinity());
    embree::Context context;
    embree::intersect1(traced_.world(), context, nullptr, ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return Met::kSkyOrFront;
    const Triangle& triangle = traced_.triangle(ray.hit.geomID, ray.hit.primID);
    if (!traced_.isBack(triangle, traced_.facet(triangle), glm::dvec3(way)))
      return Met::kSkyOrFront;
    return ray.ray.tfar > far_ ? Met::kFarBack : Met::kNearBack;
  }

  const TracedScene& traced_;
  double lift_ = 0;  // of the rays from their triangle, metres
  float far_ = 0;    // metres
};

}  // namespace

std::vector<bool> buriedTriangles(const scene::Scene& scene) {
  const TracedScene traced(scene, (scene.bounds.min + scene.bounds.max) / 2.0);
  const Burial burial(traced);
  // Bytes: threads may not write different bits of a vector<bool>.
  std::vector<uint8_t> buried(scene.indices.size() / 3, 0);
  std::vector<bool> seen(scene.primitives.size());
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const uint32_t number = scene.instances[i].primitive;
    const scene::Primitive& primitive = scene.primitives[number];
    const bool bothSides = scene.materials[primitive.material].doubleSided;
    const bool again = seen[number];
    seen[number] = true;
    forEach(primitive.indexCount / 3, [&](size_t k) {
      const auto first = static_cast<uint32_t>(primitive.firstIndex + 3 * k);
      uint8_t& own = buried[first / 3];
      if (!again || own != 0) {
        own = burial.isBuried({.instance = i, .firstIndex = first}, bothSides) ? 1 : 0;
      }
    });
  }
  return {buried.begin(), buried.end()};
}

}  // namespace grisaille::trace
