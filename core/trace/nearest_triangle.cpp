// SPDX-License-Identifier: MIT
#include "core/trace/nearest_triangle.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "core/trace/traced_scene.h"

namespace grisaille::trace {
namespace {

constexpr size_t kLanes = 16;
// Cosine of the largest angle between a ray of a packet and the first ray.
constexpr float kWidest = 0.7f;
// Embree searches on behind the nearest triangle so far, by this fraction of its distance. Far more
// than the rounding of its boxes and of all triangles except the most grazing.
constexpr float kBehind = 0x1p-10f;

// The data of a query's filter. Embree passes a pointer to `base` to the filter.
struct Query {
  embree::Context base;
  float margin = 0;
  const ThinRay* rays = nullptr;  // indexed by ray id
  Met* met = nullptr;
  bool drawnOnly = false;  // passes undrawn backs
};

// Keeps the first triangle in the order of Met. Without this filter, Embree chooses among equally
// near triangles by its traversal order, which depends on the other rays of the packet. It might
// also skip the box of an equally near triangle because of rounding.
void keepNearest(const RTCFilterFunctionNArguments* args) {
  const auto& query = *reinterpret_cast<const Query*>(args->context);
  for (unsigned int i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const uint32_t id = RTCRayN_id(args->ray, args->N, i);
    float& far = RTCRayN_tfar(args->ray, args->N, i);
    const Met candidate = {far, RTCHitN_geomID(args->hit, args->N, i),
                           RTCHitN_primID(args->hit, args->N, i), RTCHitN_u(args->hit, args->N, i),
                           RTCHitN_v(args->hit, args->N, i)};
    Met& met = query.met[id];
    const bool passed =
        query.drawnOnly && TracedScene::isUndrawnBack(args->geometryUserPtr, candidate.primitive,
                                                      glm::dvec3(query.rays[id].direction));
    if (!passed && std::tie(candidate.distance, candidate.geometry, candidate.primitive) <
                       std::tie(met.distance, met.geometry, met.primitive)) {
      met = candidate;
      far = std::min(far * (1 + kBehind) + query.margin, query.rays[id].length);
    } else {
      args->valid[i] = 0;
    }
  }
}

// Traces a packet of 1 ... kLanes rays. Also used for single rays: Embree's single-ray kernels are
// cheaper, but round differently at borders.
void traceTogether(RTCScene world, Query& query, uint32_t firstId, size_t count) {
  RTCRayHit16 packet = {};
  alignas(64) std::array<int, kLanes> valid = {};
  for (uint32_t i = 0; i < count; ++i) {
    const ThinRay& r = query.rays[firstId + i];
    valid[i] = -1;
    packet.ray.org_x[i] = r.from.x;
    packet.ray.org_y[i] = r.from.y;
    packet.ray.org_z[i] = r.from.z;
    packet.ray.dir_x[i] = r.direction.x;
    packet.ray.dir_y[i] = r.direction.y;
    packet.ray.dir_z[i] = r.direction.z;
    packet.ray.tfar[i] = r.length;
    packet.ray.mask[i] = ~0u;
    packet.ray.id[i] = firstId + i;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  embree::intersect16(valid.data(), world, query.base, keepNearest, packet);
}

// Returns how many of the leading rays run close enough to the first to share a packet with it.
size_t together(std::span<const ThinRay> rays, float spread) {
  const size_t most = std::min(rays.size(), kLanes);
  size_t count = 1;
  for (; count < most; ++count) {
    const glm::vec3 apart = rays[count].from - rays[0].from;
    if (glm::dot(apart, apart) > spread * spread) break;
    if (glm::dot(rays[count].direction, rays[0].direction) < kWidest) break;
  }
  return count;
}

}  // namespace

void NearestTriangles::findAll(std::span<const ThinRay> rays, std::span<Met> met) const {
  Query query = {.base = {}, .margin = margin_, .rays = rays.data(), .met = met.data()};
  std::ranges::fill(met, Met());
  uint32_t first = 0;
  while (first < rays.size()) {
    const size_t count = together(rays.subspan(first), spread_);
    traceTogether(world_, query, first, count);
    first += static_cast<uint32_t>(count);
  }
}

Met NearestTriangles::find(const ThinRay& ray, bool drawnOnly) const {
  Met met;
  Query query = {.base = {}, .margin = margin_, .rays = &ray, .met = &met, .drawnOnly = drawnOnly};
  traceTogether(world_, query, 0, 1);
  return met;
}

}  // namespace grisaille::trace
