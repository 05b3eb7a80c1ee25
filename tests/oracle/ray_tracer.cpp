// SPDX-License-Identifier: MIT
#include "tests/oracle/ray_tracer.h"

#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "tests/oracle/alpha_mask.h"
#include "tests/oracle/parallel.h"
#include "tests/oracle/sampling.h"

namespace grisaille::oracle {
namespace {

struct Triangle {
  uint32_t instance = 0;
  uint32_t firstIndex = 0;
};

// An instance's transform, relative to the origin.
struct Placement {
  glm::dmat3 linear = glm::dmat3(1);
  glm::dvec3 offset = glm::dvec3(0);
  glm::dmat3 normals = glm::dmat3(1);
  bool mirrored = false;
};

Placement placementOf(const scene::Instance& instance, const glm::dvec3& origin) {
  Placement p;
  p.linear = glm::dmat3(instance.worldFromObject);
  p.offset = glm::dvec3(instance.worldFromObject[3]) - origin;
  p.mirrored = glm::determinant(p.linear) < 0;
  // Cofactors: the inverse transpose up to a positive factor, and defined for flattened instances.
  const glm::dmat3& m = p.linear;
  p.normals = glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  if (p.mirrored) p.normals = -p.normals;
  return p;
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

}  // namespace

struct RayTracer::Impl {
  // Triangles with the same rules: an Embree geometry whose filters do no more than these need.
  struct Bucket {
    const Impl* tracer = nullptr;
    bool masked = false;
    bool doubleSided = false;
    std::vector<Triangle> triangles;
  };
  using Corners = std::array<glm::dvec3, 3>;

  Impl(const scene::Scene& theScene, const glm::dvec3& theOrigin)
      : scene(theScene), origin(theOrigin) {}
  ~Impl() {
    if (world != nullptr) rtcReleaseScene(world);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void place();
  void sortTriangles();
  void attach(uint32_t id, Bucket& bucket);
  void throwOnFailure(const char* what) const;

  uint32_t materialOf(const Triangle& triangle) const {
    return scene.primitives[scene.instances[triangle.instance].primitive].material;
  }
  Corners corners(const Triangle& triangle) const;
  bool isHole(const Triangle& triangle, float u, float v) const;
  bool isBack(const Triangle& triangle, const glm::dvec3& direction) const;
  void refine(const Triangle& triangle, const glm::dvec3& eye, const glm::dvec3& direction,
              Hit& hit) const;

  static void filterPrimary(const RTCFilterFunctionNArguments* args);
  static void filterOcclusion(const RTCFilterFunctionNArguments* args);

  const scene::Scene& scene;
  const glm::dvec3 origin;
  std::vector<Placement> placements;            // like scene.instances
  std::vector<std::optional<AlphaMask>> masks;  // like scene.materials
  std::array<Bucket, 4> buckets;                // index: masked + 2 * doubleSided; Embree's geomID
  RTCDevice device = nullptr;
  RTCScene world = nullptr;
};

void RayTracer::Impl::place() {
  for (const scene::Instance& instance : scene.instances) {
    placements.push_back(placementOf(instance, origin));
  }
  for (const scene::Material& material : scene.materials) {
    auto& mask = masks.emplace_back();
    if (material.masked) mask.emplace(scene, material);
  }
}

void RayTracer::Impl::sortTriangles() {
  for (uint32_t i = 0; i < buckets.size(); ++i) {
    buckets[i].tracer = this;
    buckets[i].masked = (i & 1u) != 0;
    buckets[i].doubleSided = (i & 2u) != 0;
  }
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Primitive& primitive = scene.primitives[scene.instances[i].primitive];
    const scene::Material& material = scene.materials[primitive.material];
    auto& triangles = buckets[material.masked + 2 * material.doubleSided].triangles;
    for (uint32_t k = 0; k < primitive.indexCount; k += 3) {
      triangles.push_back({i, primitive.firstIndex + k});
    }
  }
}

void RayTracer::Impl::throwOnFailure(const char* what) const {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw Error(ErrorId::kSceneTooLarge, "the ray tracer failed to {} {} triangles: Embree error {}",
              what, scene::triangleCount(scene), static_cast<int>(error));
}

void RayTracer::Impl::attach(uint32_t id, Bucket& bucket) {
  const size_t count = bucket.triangles.size();
  if (count == 0) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * count));
  auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), count));
  if (vertices != nullptr && indices != nullptr) {
    for (size_t i = 0; i < count; ++i) {
      const Corners c = corners(bucket.triangles[i]);
      for (size_t k = 0; k < 3; ++k) {
        vertices[3 * i + k] = glm::vec3(c[k]);
        indices[3 * i + k] = static_cast<uint32_t>(3 * i + k);
      }
    }
    rtcSetGeometryUserData(geometry, &bucket);
    if (bucket.masked || !bucket.doubleSided) {
      rtcSetGeometryIntersectFilterFunction(geometry, filterPrimary);
    }
    if (bucket.masked) rtcSetGeometryOccludedFilterFunction(geometry, filterOcclusion);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(world, geometry, id);
  }
  rtcReleaseGeometry(geometry);
}

RayTracer::Impl::Corners RayTracer::Impl::corners(const Triangle& triangle) const {
  const Placement& p = placements[triangle.instance];
  Corners result;
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t vertex = scene.indices[triangle.firstIndex + k];
    result[k] = p.linear * glm::dvec3(scene.positions[vertex]) + p.offset;
  }
  return result;
}

bool RayTracer::Impl::isHole(const Triangle& triangle, float u, float v) const {
  const uint32_t* index = &scene.indices[triangle.firstIndex];
  const glm::vec2 texCoord = (1.0f - u - v) * scene.texCoords[index[0]] +
                             u * scene.texCoords[index[1]] + v * scene.texCoords[index[2]];
  return masks[materialOf(triangle)]->isHole(texCoord);
}

bool RayTracer::Impl::isBack(const Triangle& triangle, const glm::dvec3& direction) const {
  const Corners c = corners(triangle);
  const double facing = glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), direction);
  return placements[triangle.instance].mirrored ? facing < 0 : facing > 0;
}

// Both filters serve single rays only: N is 1.
void RayTracer::Impl::filterPrimary(const RTCFilterFunctionNArguments* args) {
  const auto& bucket = *static_cast<const Bucket*>(args->geometryUserPtr);
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  const Triangle& triangle = bucket.triangles[hit.primID];
  const glm::dvec3 direction(ray.dir_x, ray.dir_y, ray.dir_z);
  if ((!bucket.doubleSided && bucket.tracer->isBack(triangle, direction)) ||
      (bucket.masked && bucket.tracer->isHole(triangle, hit.u, hit.v))) {
    args->valid[0] = 0;
  }
}

void RayTracer::Impl::filterOcclusion(const RTCFilterFunctionNArguments* args) {
  const auto& bucket = *static_cast<const Bucket*>(args->geometryUserPtr);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  if (bucket.tracer->isHole(bucket.triangles[hit.primID], hit.u, hit.v)) args->valid[0] = 0;
}

// Where the double ray meets the double triangle's plane: Embree's own distance has the rounding of
// 32-bit corners in it, many times more at grazing angles.
void RayTracer::Impl::refine(const Triangle& triangle, const glm::dvec3& eye,
                             const glm::dvec3& direction, Hit& hit) const {
  const Corners c = corners(triangle);
  const glm::dvec3 a = c[1] - c[0];
  const glm::dvec3 b = c[2] - c[0];
  const glm::dvec3 cross = glm::cross(a, b);
  hit.viewDepth = glm::dot(c[0] - eye, cross) / glm::dot(direction, cross);
  const glm::dvec3 position = eye + hit.viewDepth * direction;
  hit.position = position + origin;
  const double area = glm::dot(cross, cross);
  const double u = glm::clamp(glm::dot(glm::cross(position - c[0], b), cross) / area, 0.0, 1.0);
  const double v = glm::clamp(glm::dot(glm::cross(a, position - c[0]), cross) / area, 0.0, 1.0 - u);

  const Placement& p = placements[triangle.instance];
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
  hit.material = materialOf(triangle);
}

RayTracer::RayTracer(const scene::Scene& scene, const glm::dvec3& origin)
    : impl_(std::make_unique<Impl>(scene, origin)) {
  impl_->place();
  impl_->sortTriangles();
  impl_->device = rtcNewDevice(nullptr);
  impl_->throwOnFailure("start for");
  impl_->world = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->world, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->world, RTC_BUILD_QUALITY_HIGH);
  for (uint32_t id = 0; id < impl_->buckets.size(); ++id) impl_->attach(id, impl_->buckets[id]);
  rtcCommitScene(impl_->world);
  impl_->throwOnFailure("hold");
}

RayTracer::~RayTracer() = default;

std::vector<Hit> RayTracer::castPrimary(const scene::Camera& camera, uint32_t width,
                                        uint32_t height, std::span<const glm::uvec2> pixels) const {
  const double aspect = static_cast<double>(width) / static_cast<double>(height);
  const glm::dmat3 worldFromView = scene::worldFromView(camera);
  const glm::dmat4 clipFromView = scene::clipFromView(camera, aspect);
  const glm::dvec3 eye = camera.eye - impl_->origin;
  std::vector<Hit> hits(pixels.size());
  parallelFor(pixels.size(), [&](size_t i) {
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
    rtcIntersect1(impl_->world, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    impl_->refine(impl_->buckets[ray.hit.geomID].triangles[ray.hit.primID], eye, direction, hit);
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

std::vector<Visibility> RayTracer::ambientOcclusion(std::span<const Hit> hits, double radius,
                                                    uint32_t samples, uint32_t seed) const {
  std::vector<Visibility> result(hits.size());
  parallelFor(hits.size(), [&](size_t i) {
    const Hit& hit = hits[i];
    if (hit.viewDepth == 0) return;
    const glm::dvec3 position = hit.position - impl_->origin;
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
      rtcOccluded1(impl_->world, &context, &ray.ray);
      ++counted;
      open += ray.ray.tfar >= 0 ? 1 : 0;  // Embree makes it minus infinity when blocked
    }
    const float mean = static_cast<float>(open) / static_cast<float>(counted);
    result[i] = {mean, std::sqrt(mean * (1.0f - mean) / static_cast<float>(counted))};
  });
  return result;
}

}  // namespace grisaille::oracle
