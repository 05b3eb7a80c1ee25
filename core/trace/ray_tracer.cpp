// SPDX-License-Identifier: MIT
#include "core/trace/ray_tracer.h"
#include "core/scene/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/trace/nearest_triangle.h"
#include "core/trace/occlusion_rays.h"
#include "core/trace/parallel.h"
#include "core/trace/traced_scene.h"

namespace grisaille::trace {
namespace {

// A ray relative to the tracer's origin.
struct Path {
  glm::dvec3 from;
  glm::dvec3 direction;  // unit
};

// Relative rounding error of 32-bit numbers, with a safety margin.
constexpr double kRounding = 1e-6;

}  // namespace

struct RayTracer::Impl {
  Impl(const scene::Scene& theScene, const glm::dvec3& origin) : traced(theScene, origin) {
    measure();
  }

  // Sets the members below from Embree's bounds.
  void measure();
  // Fills `hit`. The view depth of `direction` is 1 m.
  void see(const Triangle& triangle, const glm::dvec3& eye, const glm::dvec3& direction,
           Hit& hit) const;
  Path pathOf(const grisaille_ray& ray) const;
  bool thinRay(const Path& path, double reach, ThinRay& thin) const;
  bool passesBorder(const Path& path, const Facet& facet, const Met& met) const;
  static grisaille_hit hitOf(const Path& path, float reach, const Facet& facet,
                             const glm::dvec3& unit);
  void castBlock(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits,
                 Backs backs) const;
  Surroundings along(const glm::dvec3& point, const glm::dvec3& direction) const;

  TracedScene traced;
  glm::dvec3 least, most;  // of all triangles, relative to the origin, with a margin
  double margin = 0;       // metres, above the largest error of a 32-bit triangle coordinate
  std::optional<NearestTriangles> nearest;
};

void RayTracer::Impl::measure() {
  RTCBounds b = {};
  rtcGetSceneBounds(traced.world(), &b);
  least = glm::dvec3(b.lower_x, b.lower_y, b.lower_z);
  most = glm::dvec3(b.upper_x, b.upper_y, b.upper_z);
  margin = kRounding * glm::length(glm::max(glm::abs(least), glm::abs(most)));
  const double spread = 0.01 * glm::length(most - least);
  nearest.emplace(traced.world(), static_cast<float>(margin), static_cast<float>(spread));
  least -= margin;
  most += margin;
}

void RayTracer::Impl::see(const Triangle& triangle, const glm::dvec3& eye,
                          const glm::dvec3& direction, Hit& hit) const {
  const Facet facet = traced.facet(triangle);
  const auto& c = facet.corners;
  const glm::dvec3 a = c[1] - c[0];
  const glm::dvec3 b = c[2] - c[0];
  const glm::dvec3& cross = facet.cross;
  hit.viewDepth = facet.crossing(eye, direction);
  const glm::dvec3 position = eye + hit.viewDepth * direction;
  hit.position = position + traced.origin();
  const double area = glm::dot(cross, cross);
  const double u = glm::clamp(glm::dot(glm::cross(position - c[0], b), cross) / area, 0.0, 1.0);
  const double v = glm::clamp(glm::dot(glm::cross(a, position - c[0]), cross) / area, 0.0, 1.0 - u);

  const Placement& p = traced.placement(triangle.instance);
  const scene::Scene& scene = traced.scene();
  const glm::dvec3 front = (p.mirrored ? -cross : cross) / std::sqrt(area);
  const double side = glm::dot(front, direction) > 0 ? -1.0 : 1.0;
  hit.facetNormal = side * front;
  const std::array<double, 3> weights = {1.0 - u - v, u, v};
  glm::dvec3 normal(0);
  for (uint32_t k = 0; k < 3; ++k) {
    const glm::vec3& object = scene.normals[scene.indices[triangle.firstIndex + k]];
    const glm::dvec3 corner = p.normals * glm::dvec3(object);
    const double length = glm::length(corner);
    if (length > 0) normal += weights[k] / length * corner;
    for (int axis = 0; axis < 3; ++axis) {
      hit.facetReach = std::max(hit.facetReach, static_cast<float>(std::abs(c[k][axis])));
    }
  }
  const double length = glm::length(normal);
  hit.normal = glm::vec3(length > 0 ? side / length * normal : hit.facetNormal);
  hit.instance = triangle.instance;
  hit.primitive = scene.instances[triangle.instance].primitive;
  hit.material = traced.materialOf(triangle);
}

RayTracer::RayTracer(const scene::Scene& scene, const glm::dvec3& origin)
    : impl_(std::make_unique<Impl>(scene, origin)) {}

RayTracer::~RayTracer() = default;

void RayTracer::follow() {
  if (impl_->traced.follow()) impl_->measure();
}

std::vector<Hit> RayTracer::castPrimary(const scene::Camera& camera, uint32_t width,
                                        uint32_t height, std::span<const glm::uvec2> pixels) const {
  const scene::View view = scene::viewOf(camera, {width, height});
  std::vector<Hit> hits(pixels.size());
  forEach(pixels.size(), [&](size_t i) {
    Hit& hit = hits[i];
    hit.pixel = pixels[i];
    const scene::ViewRay seen = scene::rayAt(view, glm::dvec2(pixels[i]) + 0.5);
    const glm::dvec3 eye = seen.origin - impl_->traced.origin(), direction = seen.direction;
    RTCRayHit ray =
        embree::makeRay(glm::vec3(eye), glm::vec3(direction), static_cast<float>(camera.nearPlane),
                        std::numeric_limits<float>::infinity());
    embree::Context context;
    embree::intersect1(impl_->traced.world(), context, TracedScene::passBackFaces, ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    impl_->see(impl_->traced.triangle(ray.hit.geomID, ray.hit.primID), eye, direction, hit);
  });
  return hits;
}

std::vector<Hit> RayTracer::castPrimary(const scene::Camera& camera, uint32_t width,
                                        uint32_t height) const {
  std::vector<glm::uvec2> pixels;
  pixels.reserve(size_t{width} * height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) pixels.emplace_back(x, y);
  }
  return castPrimary(camera, width, height, pixels);
}

// The surroundings in one direction.
Surroundings RayTracer::Impl::along(const glm::dvec3& point, const glm::dvec3& direction) const {
  constexpr int kMostCrossings = 64;
  Surroundings seen;
  float from = 0;
  for (int i = 0; i < kMostCrossings; ++i) {
    RTCRayHit ray = embree::makeRay(glm::vec3(point - traced.origin()), glm::vec3(direction), from,
                                    std::numeric_limits<float>::infinity());
    embree::Context context;
    embree::intersect1(traced.world(), context, nullptr, ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
    const Triangle& triangle = traced.triangle(ray.hit.geomID, ray.hit.primID);
    const bool back = traced.isBack(triangle, traced.facet(triangle), direction);
    seen.winding += back ? 1 : -1;
    if (i == 0) {
      seen.met = 1;
      seen.backs = back ? 1 : 0;
      seen.nearest = double{ray.ray.tfar};
    }
    from = ray.ray.tfar + static_cast<float>(margin);
    from = std::max(from, std::nextafter(ray.ray.tfar, std::numeric_limits<float>::infinity()));
  }
  return seen;
}

Path RayTracer::Impl::pathOf(const grisaille_ray& ray) const {
  const glm::dvec3 origin(ray.origin[0], ray.origin[1], ray.origin[2]);
  const glm::dvec3 direction(ray.direction[0], ray.direction[1], ray.direction[2]);
  return {origin - traced.origin(), glm::normalize(direction)};
}

Surroundings RayTracer::surroundings(const glm::dvec3& point,
                                     std::span<const glm::dvec3> directions) const {
  std::vector<Surroundings> each(directions.size());
  forEach(each.size(), [&](size_t i) { each[i] = impl_->along(point, directions[i]); });
  Surroundings all;
  for (const Surroundings& one : each) {
    all.winding += one.winding;
    all.met += one.met;
    all.backs += one.backs;
    all.nearest = std::min(all.nearest, one.nearest);
  }
  const auto count = static_cast<double>(std::max(each.size(), size_t{1}));
  all.winding /= count;
  all.met /= count;
  all.backs /= count;
  return all;
}

// Moves the origin of a ray from outside to the scene's bounds, which keeps the precision of rays
// from far outside in 32 bits. Returns false if the ray misses the bounds.
bool RayTracer::Impl::thinRay(const Path& path, double reach, ThinRay& thin) const {
  double enter = 0;
  const glm::dvec3& p = path.from;
  if (p.x < least.x || p.y < least.y || p.z < least.z || p.x > most.x || p.y > most.y ||
      p.z > most.z) {
    double leave = reach;
    for (int axis = 0; axis < 3; ++axis) {
      const double below = least[axis] - path.from[axis];
      const double above = most[axis] - path.from[axis];
      const double slope = path.direction[axis];
      if (slope == 0) {
        if (below > 0 || above < 0) return false;
        continue;
      }
      enter = std::max(enter, (slope > 0 ? below : above) / slope);
      leave = std::min(leave, (slope > 0 ? above : below) / slope);
    }
    if (enter > leave) return false;
  }
  // Allow for the rounding of Embree's distance. hitOf() drops hits beyond the reach.
  const double length = (reach - enter) * (1 + kRounding) + margin;
  thin.from = glm::vec3(enter > 0 ? path.from + enter * path.direction : path.from);
  thin.direction = glm::vec3(path.direction);
  thin.length = static_cast<float>(length);
  return true;
}

// Returns whether the ray passes within a few 32-bit digits of an edge of the facet.
bool RayTracer::Impl::passesBorder(const Path& path, const Facet& facet, const Met& met) const {
  const std::array<double, 3> weights = {1.0 - met.u - met.v, met.u, met.v};
  const double area = glm::dot(facet.cross, path.direction);
  const auto& c = facet.corners;
  bool passes = false;
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec3 side = c[(k + 1) % 3] - c[(k + 2) % 3];
    const double height = weights[k] * area;  // distance to the edge, times the edge's length
    passes |= height * height <= 4 * margin * margin * glm::dot(side, side);
  }
  return passes;
}

// `unit`: the facet's normal, pointing to either side, or 0 if the facet has no area.
grisaille_hit RayTracer::Impl::hitOf(const Path& path, float reach, const Facet& facet,
                                     const glm::dvec3& unit) {
  const double distance = std::max(facet.crossing(path.from, path.direction), 0.0);
  if (distance > reach) return {};
  const double facing = glm::dot(facet.cross, path.direction);
  const bool flat = unit == glm::dvec3(0);
  const glm::vec3 normal(flat || facing > 0 ? -(flat ? path.direction : unit) : unit);
  return {.kind = GRISAILLE_HIT_SURFACE,
          .distance = static_cast<float>(distance),
          .normal = {normal.x, normal.y, normal.z}};
}

// Casts at most kBlock rays.
void RayTracer::Impl::castBlock(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits,
                                Backs backs) const {
  std::array<Path, kBlock> paths;
  std::array<uint32_t, kBlock> owners;  // indices of the rays that meet the bounds
  std::array<ThinRay, kBlock> thin;
  std::array<Met, kBlock> met;
  size_t count = 0;
  for (uint32_t i = 0; i < rays.size(); ++i) {
    hits[i] = {};
    paths[i] = pathOf(rays[i]);
    if (thinRay(paths[i], rays[i].reach, thin[count])) owners[count++] = i;
  }
  nearest->findAll(std::span(thin).first(count), std::span(met).first(count));
  Triangle last = {.firstIndex = UINT32_MAX};
  Facet facet;
  glm::dvec3 unit;
  const auto visit = [&](const Met& m) {  // neighbours often meet the same triangle
    const Triangle& triangle = traced.triangle(m.geometry, m.primitive);
    if (triangle == last) return;
    facet = traced.facet(triangle);
    const double length = glm::length(facet.cross);
    unit = length > 0 ? facet.cross / length : glm::dvec3(0);
    last = triangle;
  };
  for (size_t k = 0; k < count; ++k) {
    if (met[k].geometry == RTC_INVALID_GEOMETRY_ID) continue;
    const uint32_t i = owners[k];
    visit(met[k]);
    if (passesBorder(paths[i], facet, met[k])) {
      met[k] = nearest->find(thin[k]);
      if (met[k].geometry == RTC_INVALID_GEOMETRY_ID) continue;
      visit(met[k]);
    }
    if (backs == Backs::kPass &&
        traced.isUndrawnBack(met[k].geometry, last, facet, paths[i].direction)) {
      met[k] = nearest->findDrawn(thin[k]);
      if (met[k].geometry == RTC_INVALID_GEOMETRY_ID) continue;
      visit(met[k]);
    }
    hits[i] = hitOf(paths[i], rays[i].reach, facet, unit);
  }
}

void RayTracer::castRays(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits,
                         Backs backs) const {
  forEachBlock(rays.size(), [&](size_t first, size_t count) {
    impl_->castBlock(rays.subspan(first, count), hits.subspan(first, count), backs);
  });
}

SurfacePoints RayTracer::surfacePoints(const SurfaceSpec& spec) const {
  return trace::surfacePoints(impl_->traced, spec);
}

void RayTracer::addOcclusion(std::span<const Hit> hits, double radius, uint32_t seed, uint32_t from,
                             uint32_t to, std::span<OcclusionCounts> counts) const {
  forEach(hits.size(), [&](size_t i) {
    const Hit& hit = hits[i];
    if (hit.viewDepth == 0) return;
    const glm::dvec3 position = hit.position - impl_->traced.origin();
    const double reach = glm::max(glm::max(std::abs(position.x), std::abs(position.y)),
                                  glm::max(std::abs(position.z), double{hit.facetReach}));
    const glm::vec3 start(position + 2e-6 * reach * hit.facetNormal);
    embree::Context context;
    countRays(hit, seed, from, to, counts[i], [&](const glm::vec3& direction) {
      RTCRayHit ray = embree::makeRay(start, direction, 0.0f, static_cast<float>(radius));
      embree::occluded1(impl_->traced.world(), context, ray.ray);
      return ray.ray.tfar >= 0;
    });
  });
}

std::vector<Visibility> RayTracer::ambientOcclusion(std::span<const Hit> hits, double radius,
                                                    uint32_t samples, uint32_t seed) const {
  std::vector<OcclusionCounts> counts(hits.size());
  addOcclusion(hits, radius, seed, 0, samples, counts);
  return visibilityOf(hits, counts);
}

}  // namespace grisaille::trace
