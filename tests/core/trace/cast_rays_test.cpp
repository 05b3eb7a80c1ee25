// SPDX-License-Identifier: MIT
// Rays of any origin, compared with a loop over all triangles in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/trace/ray_tracer.h"
#include "tests/core/trace/scene_builder.h"

namespace grisaille::trace {
namespace {

using Backs = RayTracer::Backs;
using Corners = std::array<glm::dvec3, 3>;

struct SoupTriangle {
  Corners corners;
  bool oneSided = false;
  bool mirrored = false;  // its front is where its corners go clockwise
};

grisaille_ray rayFrom(const glm::dvec3& origin, const glm::dvec3& towards, float reach) {
  const glm::vec3 d(glm::normalize(towards));
  return {{origin.x, origin.y, origin.z}, {d.x, d.y, d.z}, reach};
}

grisaille_hit cast(const RayTracer& tracer, const grisaille_ray& ray, Backs backs = Backs::kPass) {
  grisaille_hit hit = {};
  tracer.castRays({&ray, 1}, {&hit, 1}, backs);
  return hit;
}

struct Expected {
  double distance = INFINITY;
  glm::dvec3 normal = glm::dvec3(0);
  bool doubtful = false;  // the ray passes close to an edge: rounding may decide
};

Expected nearestOf(const std::vector<SoupTriangle>& triangles, const grisaille_ray& ray,
                   Backs backs) {
  const glm::dvec3 from(ray.origin[0], ray.origin[1], ray.origin[2]);
  const glm::dvec3 direction =
      glm::normalize(glm::dvec3(ray.direction[0], ray.direction[1], ray.direction[2]));
  Expected found;
  for (const SoupTriangle& triangle : triangles) {
    const Corners& c = triangle.corners;
    const glm::dvec3 a = c[1] - c[0], b = c[2] - c[0], p = glm::cross(direction, b);
    const double determinant = glm::dot(a, p);
    const glm::dvec3 s = from - c[0], q = glm::cross(s, a);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(b, q) / determinant;
    const double inside = std::min({u, v, 1 - u - v});
    const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    const bool isBack = (glm::dot(normal, direction) > 0) != triangle.mirrored;
    if (backs == Backs::kPass && triangle.oneSided && isBack) continue;
    const double cosine = std::abs(glm::dot(normal, direction));
    if (t > -1e-3 && t < ray.reach * 1.001 &&
        (std::abs(inside) < 1e-3 / cosine || std::abs(t) < 1e-3 ||
         std::abs(t - ray.reach) < 1e-3)) {
      found.doubtful = true;
    }
    if (inside < 0 || t < 0 || t > ray.reach || t > found.distance) continue;
    found.distance = t;
    found.normal = glm::dot(normal, direction) > 0 ? -normal : normal;
  }
  return found;
}

// Triangles of all sizes in a cube of 20 m, one-sided or two-sided, half of them mirrored.
struct Soup {
  SceneBuilder builder;
  std::vector<SoupTriangle> triangles;

  Soup(uint32_t seed, const glm::dvec3& centre) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto point = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    const std::array materials = {builder.material({}),
                                  builder.material({.name = "both", .doubleSided = true})};
    for (uint32_t i = 0; i < 60; ++i) {
      const glm::vec3 middle = 10.0f * point();
      const float size = std::exp2(2.0f * unit(random));
      const std::array corners = {middle + size * point(), middle + size * point(),
                                  middle + size * point(), middle};
      const glm::dmat4 placed = glm::scale(glm::translate(glm::dmat4(1), centre),
                                           glm::dvec3(i % 2 == 0 ? 1 : -1, 1, 0.5));
      builder.place(builder.quad(corners, materials[i / 2 % 2]), placed);
      Corners c;
      for (size_t k = 0; k < 4; ++k) {
        const glm::dvec3 corner(placed * glm::dvec4(glm::dvec3(corners[k]), 1));
        if (k == 3) c = {c[0], c[2], corner};
        if (k < 3) c[k] = corner;
        if (k >= 2) triangles.push_back({c, i / 2 % 2 == 0, i % 2 != 0});
      }
    }
  }
};

TEST(CastRays, FindTheNearestTriangle) {
  size_t hits = 0, misses = 0;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const Backs backs = seed < 20 ? Backs::kPass : Backs::kBlock;
    const glm::dvec3 centre = seed % 2 == 0 ? glm::dvec3(0) : glm::dvec3(1e6, -3e5, 0.125);
    const Soup soup(seed, centre);
    const RayTracer tracer(soup.builder.scene, centre);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto point = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
    for (int i = 0; i < 1500; ++i) {
      // From inside the cube, near it, and far away.
      const double away = std::array{5.0, 40.0, 1e5}[static_cast<size_t>(i % 3)];
      const glm::dvec3 origin = centre + away * point();
      const float reach = i % 2 == 0 ? INFINITY : static_cast<float>(2 * away);
      const grisaille_ray ray = rayFrom(origin, centre + 10.0 * point() - origin, reach);
      const Expected expected = nearestOf(soup.triangles, ray, backs);
      if (expected.doubtful) continue;
      const grisaille_hit hit = cast(tracer, ray, backs);
      ASSERT_EQ(hit.kind, expected.distance < INFINITY ? GRISAILLE_HIT_SURFACE : GRISAILLE_HIT_NONE)
          << "seed " << seed << " ray " << i << " distance " << expected.distance;
      if (hit.kind == GRISAILLE_HIT_NONE) {
        EXPECT_EQ(hit.distance, 0);
        ++misses;
        continue;
      }
      EXPECT_NEAR(hit.distance, expected.distance, 1e-7 * expected.distance);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(hit.normal[axis], expected.normal[axis], 1e-6);
      ++hits;
    }
  }
  EXPECT_GT(hits, 1000u);
  EXPECT_GT(misses, 1000u);
}

TEST(CastRays, ABatchOfAnySizeGivesWhatSingleRaysGive) {
  const Soup soup(7, glm::dvec3(0));
  const RayTracer tracer(soup.builder.scene, glm::dvec3(0));
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<grisaille_ray> rays;
  for (int i = 0; i < 3000; ++i) {
    rays.push_back(rayFrom({0, 0, 0}, {normal(random), normal(random), normal(random)}, INFINITY));
  }
  for (const size_t count : {0u, 1u, 63u, 64u, 65u, 129u, 3000u}) {
    std::vector<grisaille_hit> hits(count, {.kind = 99, .distance = -1, .normal = {}});
    tracer.castRays(std::span(rays).first(count), hits);
    for (size_t i = 0; i < count; ++i) {
      const grisaille_hit alone = cast(tracer, rays[i]);
      ASSERT_EQ(hits[i].kind, alone.kind);
      ASSERT_EQ(hits[i].distance, alone.distance);
      for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(hits[i].normal[axis], alone.normal[axis]);
    }
  }
}

TEST(CastRays, ReachEndsExactly) {
  SceneBuilder builder;
  builder.place(
      builder.floor(glm::vec3(0), 10, builder.material({.name = "both", .doubleSided = true})));
  const RayTracer tracer(builder.scene, glm::dvec3(0));
  for (const float height : {0.001f, 0.7f, 3.0f, 1000.0f}) {
    for (const double side : {1.0, -1.0}) {
      const glm::dvec3 origin(0.3, side * height, 0.2), down(0, -side, 0);
      const grisaille_hit hit = cast(tracer, rayFrom(origin, down, height));
      EXPECT_EQ(hit.kind, GRISAILLE_HIT_SURFACE) << height;
      EXPECT_EQ(hit.distance, height);
      EXPECT_EQ(hit.normal[1], side);
      EXPECT_EQ(cast(tracer, rayFrom(origin, down, std::nextafter(height, 0.0f))).kind,
                GRISAILLE_HIT_NONE);
      EXPECT_EQ(cast(tracer, rayFrom(origin, -down, INFINITY)).kind, GRISAILLE_HIT_NONE);
    }
  }
}

TEST(CastRays, CutOutMaterialsLetThroughAndFlatScenesAreMet) {
  SceneBuilder builder;
  const uint32_t ground = builder.material({.name = "both", .doubleSided = true});
  const uint32_t cut =
      builder.material({.name = "cut", .baseColor = {1, 1, 1, 0.4f}, .masked = true});
  builder.place(builder.floor(glm::vec3(0, 1, 0), 10, cut));
  builder.place(builder.floor(glm::vec3(0), 10, ground));
  const RayTracer tracer(builder.scene, glm::dvec3(0));
  EXPECT_EQ(cast(tracer, rayFrom({0, 3, 0}, {0, -1, 0}, INFINITY)).distance, 3);
  EXPECT_EQ(cast(tracer, rayFrom({0, -3, 0}, {0, 1, 0}, INFINITY)).distance, 3);
  // Along the plane, where no crossing is well defined: a hit, if any, is on the floor.
  const grisaille_hit along = cast(tracer, rayFrom({-50, 0, 0.5}, {1, 0, 0}, INFINITY));
  if (along.kind == GRISAILLE_HIT_SURFACE) {
    EXPECT_GE(along.distance, 40);
    EXPECT_LE(along.distance, 60);
  }
}

// A sphere's winding number is 1 inside and 0 outside; turned inside out, -1 inside.
TEST(CastRays, SurroundingsTellInsideFromOutside) {
  std::vector<glm::dvec3> directions;
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 400; ++i) {
    directions.push_back(
        glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  }
  for (const double turned : {1.0, -1.0}) {
    SceneBuilder builder;
    builder.place(builder.sphere(glm::vec3(0), 1, builder.material({})));
    if (turned < 0) {
      for (size_t i = 0; i < builder.scene.indices.size(); i += 3) {
        std::swap(builder.scene.indices[i], builder.scene.indices[i + 1]);
      }
    }
    const RayTracer tracer(builder.scene, glm::dvec3(0));
    const Surroundings inside = tracer.surroundings({0.2, 0.1, 0.3}, directions);
    EXPECT_NEAR(inside.winding, turned, 0.02);
    EXPECT_EQ(inside.met, 1);
    EXPECT_EQ(inside.backs, turned > 0 ? 1 : 0);
    EXPECT_NEAR(inside.nearest, 1 - std::sqrt(0.14), 0.03);
    const Surroundings outside = tracer.surroundings({2, 0, 0}, directions);
    EXPECT_NEAR(outside.winding, 0, 0.02);
    EXPECT_NEAR(outside.met, (1 - std::sqrt(0.75)) / 2, 0.03);  // the sphere's solid angle
    EXPECT_EQ(outside.backs, turned > 0 ? 0 : outside.met);
    EXPECT_NEAR(outside.nearest, 1, 0.05);
  }
}

// Moving the scene by a million metres changes nothing.
TEST(CastRays, NothingChangesFarFromTheWorldsOrigin) {
  const glm::dvec3 away(1e6, 2e6, -4e6);  // whole numbers: the sums below are exact
  const Soup near(5, glm::dvec3(0)), far(5, away);
  const RayTracer nearTracer(near.builder.scene, glm::dvec3(0)), farTracer(far.builder.scene, away);
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 direction(normal(random), normal(random), normal(random));
    const grisaille_hit a = cast(nearTracer, rayFrom({0.5, 0.25, -1}, direction, 30));
    const grisaille_hit b =
        cast(farTracer, rayFrom(away + glm::dvec3(0.5, 0.25, -1), direction, 30));
    ASSERT_EQ(a.kind, b.kind);
    ASSERT_EQ(a.distance, b.distance);
  }
}

}  // namespace
}  // namespace grisaille::trace
