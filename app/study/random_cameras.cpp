// SPDX-License-Identifier: MIT
#include "app/study/random_cameras.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <random>

#include "core/trace/ray_tracer.h"

namespace grisaille::app::study {
namespace {

constexpr size_t kTriesWithin = 400, kTriesOutside = 120;  // for each camera
constexpr double kClearance = 0.01;                        // of the scene's diagonal
constexpr double kSteepest = 0.35;                         // radians up or down, within the scene
constexpr double kInside = 0.5;                            // winding number
constexpr double kMostBacks = 0.6;                         // of the surfaces around the eye
constexpr int kEyesEach = 12;                              // around the surfaces of one try outside
constexpr double kSurrounded = 0.5;                        // of all directions, within a scene
// A third of the pixels, and a margin for the coarse picture and its few rays.
constexpr double kLeastOccluded = 0.4;
constexpr uint32_t kWidth = 32, kHeight = 18, kRays = 64;

// A number in [0, 1), the same on every machine; std::uniform_real_distribution does not promise
// that.
double unit(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0;
}

// Evenly spread directions: a Fibonacci lattice on the sphere.
std::vector<glm::dvec3> directions() {
  constexpr int kCount = 96;
  std::vector<glm::dvec3> all;
  for (int i = 0; i < kCount; ++i) {
    const double y = 1 - (2 * i + 1) / double{kCount}, r = std::sqrt(1 - y * y);
    const double angle = i * glm::two_pi<double>() * 0.6180339887498949;
    all.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
  }
  return all;
}

// A direction with a random heading, `pitch` radians above the horizon.
glm::dvec3 heading(std::mt19937& random, double pitch) {
  const double angle = glm::two_pi<double>() * unit(random);
  return {std::cos(angle) * std::cos(pitch), std::sin(pitch), std::sin(angle) * std::cos(pitch)};
}

grisaille_ray rayOf(const glm::dvec3& origin, const glm::dvec3& direction, double reach) {
  const glm::vec3 d(direction);
  return {.origin = {origin.x, origin.y, origin.z},
          .direction = {d.x, d.y, d.z},
          .reach = static_cast<float>(reach)};
}

class Finder {
 public:
  Finder(const scene::Scene& scene, const RandomCameraDesc& desc)
      : desc_(desc),
        bounds_(scene.bounds),
        diagonal_(glm::length(bounds_.max - bounds_.min)),
        clearance_(kClearance * diagonal_),
        nearest_(std::min(1.5 * desc.radius, 0.15 * diagonal_)),
        farthest_(std::max(nearest_, std::min(12 * desc.radius, diagonal_))),
        tracer_(scene, centre()) {}

  // Whether a user can stand inside the scene: in a share of its bounds, an eye is free and
  // surrounded. The share is 0.1 in a wood and 0.4 in a building, but 0.04 around a vehicle.
  bool isPlace(std::mt19937& random) const {
    constexpr int kPoints = 300;
    constexpr double kLeastShare = 0.06;
    int good = 0;
    for (int i = 0; i < kPoints; ++i) good += isFree(pointIn(random, 1), kSurrounded);
    return good >= kLeastShare * kPoints;
  }

  // A camera that satisfies randomCameras()'s list; none: this try failed.
  std::optional<scene::Camera> within(std::mt19937& random) const {
    const glm::dvec3 eye = pointIn(random, 1);
    const scene::Camera camera =
        cameraAt(eye, eye + heading(random, kSteepest * (2 * unit(random) - 1)));
    return isGood(camera, kSurrounded) ? std::optional(camera) : std::nullopt;
  }

  // The same, with the eye anywhere around an occluded surface.
  std::optional<scene::Camera> outside(std::mt19937& random) const {
    const glm::dvec3 aim = pointIn(random, 0.5);
    const scene::Camera far = cameraAt(aim + diagonal_ * heading(random, 1.2 * unit(random)), aim);
    const std::vector<trace::Hit> hits = tracer_.castPrimary(far, kWidth, kHeight);
    const std::vector<trace::Visibility> seen = tracer_.ambientOcclusion(hits, desc_.radius, 16, 1);
    std::vector<const trace::Hit*> occluded;
    for (size_t i = 0; i < hits.size(); ++i) {
      if (seen[i].mean < kOccluded) occluded.push_back(&hits[i]);
    }
    if (occluded.empty()) return std::nullopt;
    for (int i = 0; i < kEyesEach; ++i) {
      const auto chosen = unit(random) * static_cast<double>(occluded.size());
      const trace::Hit& hit = *occluded[static_cast<size_t>(chosen)];
      const double away = nearest_ * std::pow(farthest_ / nearest_, unit(random));
      const glm::dvec3 back = heading(random, 0.9 * unit(random));
      if (glm::dot(back, hit.facetNormal) <= 0) continue;
      const scene::Camera camera = cameraAt(hit.position + away * back, hit.position);
      if (isGood(camera, 0)) return camera;
    }
    return std::nullopt;
  }

 private:
  glm::dvec3 centre() const { return (bounds_.min + bounds_.max) / 2.0; }

  // A point in the bounds, shrunk about their centre.
  glm::dvec3 pointIn(std::mt19937& random, double shrunk) const {
    const double x = unit(random), y = unit(random), z = unit(random);
    return centre() + shrunk * (glm::dvec3(x, y, z) - 0.5) * (bounds_.max - bounds_.min);
  }

  scene::Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target) const {
    scene::Camera camera = desc_.like;
    camera.eye = eye;
    camera.target = target;
    camera.up = glm::dvec3(0, 1, 0);
    // The near plane cuts off no surface, not even in the picture's corners.
    camera.nearPlane = std::min(camera.nearPlane, 0.4 * clearance_);
    return camera;
  }

  // `least`: share of all directions from the eye that meet the scene.
  bool isFree(const glm::dvec3& eye, double least) const {
    const trace::Surroundings around = tracer_.surroundings(eye, directions_);
    return around.winding < kInside && around.backs <= kMostBacks * around.met &&
           around.nearest >= clearance_ && around.met >= least;
  }

  bool isGood(const scene::Camera& camera, double least) const {
    if (!isFree(camera.eye, least)) return false;
    const std::vector<trace::Hit> hits = tracer_.castPrimary(camera, kWidth, kHeight);
    return seesFar(camera, hits) && isOccluded(hits);
  }

  bool seesFar(const scene::Camera& camera, const std::vector<trace::Hit>& hits) const {
    std::vector<grisaille_ray> rays;
    size_t far = 0, through = 0;
    for (const trace::Hit& hit : hits) {
      if (hit.viewDepth == 0) continue;
      if (hit.viewDepth < clearance_) return false;
      if (hit.viewDepth > 5 * clearance_) ++far;
      // A ray to just before the visible point can only hit the back of a surface.
      const glm::dvec3 way = hit.position - camera.eye;
      rays.push_back(rayOf(camera.eye, glm::normalize(way), 0.99 * glm::length(way)));
    }
    std::vector<grisaille_hit> between(rays.size());
    tracer_.castRays(rays, between, trace::RayTracer::Backs::kBlock);
    for (const grisaille_hit& hit : between) through += hit.kind == GRISAILLE_HIT_SURFACE;
    return far * 2 >= rays.size() && through * 20 <= rays.size();
  }

  bool isOccluded(const std::vector<trace::Hit>& hits) const {
    const auto glance = tracer_.ambientOcclusion(hits, desc_.radius, kRays / 8, 1);
    const auto some = std::ranges::count_if(glance, [](const auto& one) { return one.mean < 1; });
    if (some * 10 < std::ssize(hits)) return false;
    const auto seen = tracer_.ambientOcclusion(hits, desc_.radius, kRays, 1);
    return occludedShare(trace::visibilityImage(seen, kWidth, kHeight)) >= kLeastOccluded;
  }

  const RandomCameraDesc& desc_;
  scene::Bounds bounds_;
  double diagonal_, clearance_;  // metres
  double nearest_, farthest_;    // of an eye outside from its aim, metres
  trace::RayTracer tracer_;
  std::vector<glm::dvec3> directions_ = directions();
};

}  // namespace

double occludedShare(const image::Image& visibility) {
  const auto occluded =
      std::ranges::count_if(visibility.pixels, [](float value) { return value < kOccluded; });
  return static_cast<double>(occluded) /
         static_cast<double>(std::max(visibility.pixels.size(), size_t{1}));
}

std::vector<scene::Camera> randomCameras(const scene::Scene& scene, const RandomCameraDesc& desc) {
  const Finder finder(scene, desc);
  std::mt19937 random(desc.seed);
  std::vector<scene::Camera> cameras;
  const auto draw = [&](size_t tries, const auto& once) {
    for (size_t i = 0; i < desc.count * tries && cameras.size() < desc.count; ++i) {
      if (const auto camera = once()) cameras.push_back(*camera);
    }
  };
  if (finder.isPlace(random)) draw(kTriesWithin, [&] { return finder.within(random); });
  draw(kTriesOutside, [&] { return finder.outside(random); });
  return cameras;
}

}  // namespace grisaille::app::study
