// SPDX-License-Identifier: MIT
#include "app/study/random_cameras.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "core/trace/ray_tracer.h"

namespace grisaille::app::study {
namespace {

constexpr size_t kTriesEach = 400;
constexpr double kClearance = 0.01;  // of the scene's diagonal
constexpr double kFarthest = 1e6;    // metres
constexpr double kSteepest = 0.35;   // radians up or down

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

grisaille_ray rayOf(const glm::dvec3& origin, const glm::dvec3& direction, double reach) {
  const glm::vec3 d(direction);
  return {.origin = {origin.x, origin.y, origin.z},
          .direction = {d.x, d.y, d.z},
          .reach = static_cast<float>(reach)};
}

class Finder {
 public:
  explicit Finder(const scene::Scene& scene)
      : bounds_(scene.bounds),
        clearance_(kClearance * glm::length(scene.bounds.max - scene.bounds.min)),
        tracer_(scene, (scene.bounds.min + scene.bounds.max) / 2.0) {}

  bool isFree(const glm::dvec3& eye) const {
    std::vector<grisaille_ray> rays;
    for (const glm::dvec3& d : directions_) rays.push_back(rayOf(eye, d, kFarthest));
    std::vector<grisaille_hit> hits(rays.size());
    tracer_.castRays(rays, hits);
    size_t met = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].kind != GRISAILLE_HIT_SURFACE) continue;
      if (hits[i].distance < clearance_) return false;
      ++met;
    }
    return met * 2 >= hits.size();
  }

  bool isGoodView(const scene::Camera& camera) const {
    constexpr uint32_t kWidth = 32, kHeight = 18;
    const std::vector<trace::Hit> hits = tracer_.castPrimary(camera, kWidth, kHeight);
    std::vector<grisaille_ray> rays;
    size_t surfaces = 0, far = 0, through = 0;
    for (const trace::Hit& hit : hits) {
      if (hit.viewDepth == 0) continue;
      if (hit.viewDepth < clearance_) return false;
      ++surfaces;
      if (hit.viewDepth > 3 * clearance_) ++far;
      // A ray to just before the visible point can only hit the back of a surface.
      const glm::dvec3 way = hit.position - camera.eye;
      rays.push_back(rayOf(camera.eye, glm::normalize(way), 0.99 * glm::length(way)));
    }
    std::vector<grisaille_hit> between(rays.size());
    tracer_.castRays(rays, between);
    for (const grisaille_hit& hit : between) through += hit.kind == GRISAILLE_HIT_SURFACE;
    return surfaces * 4 >= hits.size() * 3 && far * 2 >= surfaces && through * 20 <= surfaces;
  }

  glm::dvec3 randomPoint(std::mt19937& random) const {
    const glm::dvec3 share(unit(random), unit(random), unit(random));
    return bounds_.min + share * (bounds_.max - bounds_.min);
  }

 private:
  scene::Bounds bounds_;
  double clearance_;
  trace::RayTracer tracer_;
  std::vector<glm::dvec3> directions_ = directions();
};

}  // namespace

std::vector<scene::Camera> randomCameras(const scene::Scene& scene, const scene::Camera& like,
                                         size_t count, uint32_t seed) {
  const Finder finder(scene);
  std::mt19937 random(seed);
  std::vector<scene::Camera> cameras;
  for (size_t i = 0; i < count * kTriesEach && cameras.size() < count; ++i) {
    scene::Camera camera = like;
    camera.up = glm::dvec3(0, 1, 0);
    camera.eye = finder.randomPoint(random);
    const double heading = glm::two_pi<double>() * unit(random);
    const double pitch = kSteepest * (2 * unit(random) - 1);
    camera.target = camera.eye + glm::dvec3(std::cos(heading) * std::cos(pitch), std::sin(pitch),
                                            std::sin(heading) * std::cos(pitch));
    if (finder.isFree(camera.eye) && finder.isGoodView(camera)) cameras.push_back(camera);
  }
  return cameras;
}

}  // namespace grisaille::app::study
