// SPDX-License-Identifier: MIT
#include "core/trace/ray_tracer.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/trace/sampling.h"
#include "core/trace/traced_scene.h"

namespace grisaille::trace {
namespace {

// Calls work(index) for 0 ... count - 1 on all cores, in no order; a block or less stays on the
// calling thread. `work` does not throw and writes only what belongs to its index, so that the
// outcome is the same for any number of threads.
template <typename Work>
void forEach(size_t count, const Work& work) {
  constexpr size_t kBlock = 64;
  const tbb::blocked_range<size_t> all(0, count, kBlock);
  const auto run = [&](const tbb::blocked_range<size_t>& part) {
    for (size_t i = part.begin(); i < part.end(); ++i) work(i);
  };
  if (count <= kBlock) return run(all);
  tbb::parallel_for(all, run);
}

RTCRayHit makeRay(const glm::vec3& origin, const glm::vec3& direction, float near, float far) {
  RTCRayHit ray = {};
  ray.ray.org_x = origin.x;
  ray.ray.org_y = origin.y;
  ray.ray.org_z = origin.z;
  ray.ray.tnear = near;
  ray.ray.dir_x = direction.x;
  ray.ray.dir_y = direction.y;
  ray.ray.dir_z = direction.z;
  ray.ray.tfar = far;
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

// A ray relative to the tracer's origin.
struct Path {
  glm::dvec3 from = glm::dvec3(0);
  glm::dvec3 direction = glm::dvec3(0);  // unit
  double enter = 0;                      // metres along it to where it meets the scene's bounds
  double length = 0;                     // metres from there on
  bool misses = false;                   // all of the bounds
};

// Of 32-bit numbers, with some room, as a share of them.
constexpr double kRounding = 1e-6;

}  // namespace

struct RayTracer::Impl {
  Impl(const scene::Scene& theScene, const glm::dvec3& origin) : traced(theScene, origin) {
    RTCBounds b = {};
    rtcGetSceneBounds(traced.world(), &b);
    least = glm::dvec3(b.lower_x, b.lower_y, b.lower_z);
    most = glm::dvec3(b.upper_x, b.upper_y, b.upper_z);
    margin = kRounding * glm::length(glm::max(glm::abs(least), glm::abs(most)));
    least -= margin;
    most += margin;
  }

  // `direction` is as long as it takes to go 1 m of view depth.
  void see(const Triangle& triangle, const glm::dvec3& eye, const glm::dvec3& direction,
           Hit& hit) const;
  Path pathOf(const grisaille_ray& ray) const;
  grisaille_hit hitOf(const Path& path, float reach, const Triangle& triangle) const;

  TracedScene traced;
  glm::dvec3 least, most;  // of all triangles, relative to the origin, with a margin
  double margin = 0;       // metres that a 32-bit coordinate of theirs may be off, and more
};

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

std::vector<Hit> RayTracer::castPrimary(const scene::Camera& camera, uint32_t width,
                                        uint32_t height, std::span<const glm::uvec2> pixels) const {
  const double aspect = static_cast<double>(width) / static_cast<double>(height);
  const glm::dmat3 worldFromView = scene::worldFromView(camera);
  const glm::dmat4 clipFromView = scene::clipFromView(camera, aspect);
  const glm::dvec3 eye = camera.eye - impl_->traced.origin();
  std::vector<Hit> hits(pixels.size());
  forEach(pixels.size(), [&](size_t i) {
    Hit& hit = hits[i];
    hit.pixel = pixels[i];
    const double x = 2.0 * (pixels[i].x + 0.5) / width - 1.0;
    const double y = 1.0 - 2.0 * (pixels[i].y + 0.5) / height;
    // View depth 1, so that distances along the ray are view depths.
    const glm::dvec3 direction =
        worldFromView * glm::dvec3(x / clipFromView[0][0], y / clipFromView[1][1], -1.0);
    RTCRayHit ray =
        makeRay(glm::vec3(eye), glm::vec3(direction), static_cast<float>(camera.nearPlane),
                std::numeric_limits<float>::infinity());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.filter = TracedScene::passBackFaces;
    rtcIntersect1(impl_->traced.world(), &context, &ray);
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

// Enters the bounds first, so that a ray from far outside loses nothing in 32 bits.
Path RayTracer::Impl::pathOf(const grisaille_ray& ray) const {
  Path path;
  path.from = glm::dvec3(ray.origin[0], ray.origin[1], ray.origin[2]) - traced.origin();
  path.direction = glm::normalize(glm::dvec3(ray.direction[0], ray.direction[1], ray.direction[2]));
  double leave = ray.reach;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = least[axis] - path.from[axis];
    const double above = most[axis] - path.from[axis];
    const double slope = path.direction[axis];
    if (slope == 0) {
      if (below > 0 || above < 0) path.misses = true;
      continue;
    }
    path.enter = std::max(path.enter, (slope > 0 ? below : above) / slope);
    leave = std::min(leave, (slope > 0 ? above : below) / slope);
  }
  if (path.enter > leave) path.misses = true;
  // Embree's distance is off by its rounding: what lies beyond the reach by that is dropped later.
  path.length = (ray.reach - path.enter) * (1 + kRounding) + margin;
  return path;
}

grisaille_hit RayTracer::Impl::hitOf(const Path& path, float reach,
                                     const Triangle& triangle) const {
  const Facet facet = traced.facet(triangle);
  const double distance = std::fmax(facet.crossing(path.from, path.direction), 0.0);
  if (distance > reach) return {};
  const double length = glm::length(facet.cross);
  const double side = glm::dot(facet.cross, path.direction) > 0 ? -1.0 : 1.0;
  const glm::vec3 normal(length > 0 ? side / length * facet.cross : -path.direction);
  return {.kind = GRISAILLE_HIT_SURFACE,
          .distance = static_cast<float>(distance),
          .normal = {normal.x, normal.y, normal.z}};
}

void RayTracer::castRays(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) const {
  forEach(rays.size(), [&](size_t i) {
    hits[i] = {};
    const Path path = impl_->pathOf(rays[i]);
    if (path.misses) return;
    const glm::vec3 start(path.from + path.enter * path.direction);
    RTCRayHit ray =
        makeRay(start, glm::vec3(path.direction), 0.0f, static_cast<float>(path.length));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(impl_->traced.world(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    const Triangle& triangle = impl_->traced.triangle(ray.hit.geomID, ray.hit.primID);
    hits[i] = impl_->hitOf(path, rays[i].reach, triangle);
  });
}

std::vector<Visibility> RayTracer::ambientOcclusion(std::span<const Hit> hits, double radius,
                                                    uint32_t samples, uint32_t seed) const {
  std::vector<Visibility> result(hits.size());
  forEach(hits.size(), [&](size_t i) {
    const Hit& hit = hits[i];
    if (hit.viewDepth == 0) return;
    const glm::dvec3 position = hit.position - impl_->traced.origin();
    const double reach = glm::max(glm::max(std::abs(position.x), std::abs(position.y)),
                                  glm::max(std::abs(position.z), double{hit.facetReach}));
    const glm::vec3 start(position + 2e-6 * reach * hit.facetNormal);
    const glm::vec3 facetNormal(hit.facetNormal);
    const glm::mat3 frame = frameAbout(hit.normal);
    const uint32_t scramble = hashBits(hit.pixel.x + hashBits(hit.pixel.y + hashBits(seed)));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    uint32_t counted = 0;
    uint32_t open = 0;
    for (uint32_t s = 0; s < samples; ++s) {
      const glm::vec3 direction = frame * cosineDirection(sobolPoint(s, scramble));
      if (glm::dot(direction, facetNormal) <= 0) continue;
      RTCRayHit ray = makeRay(start, direction, 0.0f, static_cast<float>(radius));
      rtcOccluded1(impl_->traced.world(), &context, &ray.ray);
      ++counted;
      open += ray.ray.tfar >= 0 ? 1 : 0;  // Embree makes it minus infinity when blocked
    }
    const float mean = static_cast<float>(open) / static_cast<float>(counted);
    result[i] = {mean, std::sqrt(mean * (1.0f - mean) / static_cast<float>(counted))};
  });
  return result;
}

}  // namespace grisaille::trace
