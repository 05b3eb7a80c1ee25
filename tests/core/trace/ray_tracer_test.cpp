// SPDX-License-Identifier: MIT
// Results of primary rays: depth, normals, facing, holes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/trace/ray_tracer.h"
#include "tests/core/trace/scene_builder.h"

namespace grisaille::trace {
namespace {

constexpr uint32_t kTracedWidth = 64;
constexpr uint32_t kTracedHeight = 36;

// View depth at which a pixel's ray meets a horizontal plane, computed from the camera's
// definition: eye, target, full vertical angle; y points down.
double planeDepth(const scene::Camera& camera, glm::uvec2 pixel, double planeY) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::dvec3 up = glm::cross(right, forward);
  const double tangent = std::tan(camera.fovyDegrees * std::numbers::pi / 360.0);
  const double x = (2.0 * (pixel.x + 0.5) - kTracedWidth) / kTracedHeight * tangent;
  const double y = (1.0 - 2.0 * (pixel.y + 0.5) / kTracedHeight) * tangent;
  const glm::dvec3 direction = forward + x * right + y * up;
  return direction.y < 0 ? (planeY - camera.eye.y) / direction.y : 0;
}

TEST(RayTracer, DepthOfAPlaneIsExactNearAndFarFromTheWorldsOrigin) {
  for (const double away : {0.0, 1000.0, 1e6}) {
    SceneBuilder builder;
    const uint32_t floor = builder.floor(glm::vec3(0), 1000, builder.material({}));
    const glm::dvec3 centre(away, 0.25 * away, -away);
    builder.place(floor, glm::translate(glm::dmat4(1), centre));
    const scene::Camera camera =
        cameraAt(centre + glm::dvec3(0.3, 1.7, 0.1), centre + glm::dvec3(6, 0.9, -3));
    const auto hits =
        RayTracer(builder.scene, camera.eye).castPrimary(camera, kTracedWidth, kTracedHeight);
    ASSERT_EQ(hits.size(), size_t{kTracedWidth} * kTracedHeight);
    size_t compared = 0;
    for (const Hit& hit : hits) {
      const double expected = planeDepth(camera, hit.pixel, centre.y);
      if (expected == 0) {
        EXPECT_EQ(hit.viewDepth, 0);
      }
      if (expected == 0 || expected > 900) continue;
      EXPECT_NEAR(hit.viewDepth, expected, 1e-7 * expected) << away << " m away";
      EXPECT_NEAR(hit.position.y, centre.y, 1e-9 * (1 + away));
      ++compared;
    }
    EXPECT_GT(compared, hits.size() / 4);
  }
}

TEST(RayTracer, NormalsOfASphereAreRadialUnderAnyTransform) {
  SceneBuilder builder;
  const uint32_t sphere = builder.sphere(glm::vec3(0), 1, builder.material({}));
  // An ellipsoid: x^2 / 4 + y^2 + z^2 / 0.25 = 1, unmirrored and mirrored in x.
  for (const double mirror : {1.0, -1.0}) {
    builder.scene.instances.clear();
    builder.place(sphere, glm::scale(glm::dmat4(1), glm::dvec3(2 * mirror, 1, 0.5)));
    const scene::Camera camera = cameraAt({1, 2, 4}, {0, 0, 0});
    const auto hits =
        RayTracer(builder.scene, camera.eye).castPrimary(camera, kTracedWidth, kTracedHeight);
    size_t seen = 0;
    for (const Hit& hit : hits) {
      if (hit.viewDepth == 0) continue;
      const glm::dvec3 expected = glm::normalize(hit.position / glm::dvec3(4, 1, 0.25));
      EXPECT_GT(glm::dot(expected, glm::dvec3(hit.normal)), 0.9995);
      EXPECT_GT(glm::dot(hit.facetNormal, camera.eye - hit.position), 0);
      EXPECT_NEAR(glm::length(hit.normal), 1, 1e-6);
      ++seen;
    }
    EXPECT_GT(seen, 100u) << "mirror " << mirror;
  }
}

TEST(RayTracer, BackFacesAreSeenOnlyWhenDoubleSidedAndMirroringTurnsThem) {
  for (const bool doubleSided : {false, true}) {
    for (const bool mirrored : {false, true}) {
      for (const bool fromFront : {false, true}) {
        SceneBuilder builder;
        const uint32_t material = builder.material({.name = "card", .doubleSided = doubleSided});
        const uint32_t card =
            builder.quad({glm::vec3(-1, -1, 0), {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, material);
        // Mirroring in x reverses the winding as seen; the normal (0, 0, 1) stays.
        builder.place(card, glm::scale(glm::dmat4(1), glm::dvec3(mirrored ? -1 : 1, 1, 1)));
        const double side = fromFront ? 1 : -1;
        const scene::Camera camera = cameraAt({0.1, 0.2, 2 * side}, {0, 0, 0});
        const Hit hit = RayTracer(builder.scene, camera.eye).castPrimary(camera, 1, 1).front();
        EXPECT_EQ(hit.viewDepth > 0, doubleSided || fromFront)
            << doubleSided << mirrored << fromFront;
        if (hit.viewDepth == 0) continue;
        EXPECT_NEAR(hit.normal.z, side, 1e-6);
        EXPECT_NEAR(hit.facetNormal.z, side, 1e-6);
        EXPECT_EQ(hit.material, material);
      }
    }
  }
}

// A 2 x 1 image: the left texel has alpha 1, the right one alpha 0.
scene::Texture halfMask(scene::Wrap wrap) {
  const image::Image8 texels{
      .width = 2, .height = 1, .pixels = {255, 255, 255, 255, 255, 255, 255, 0}};
  return {.name = "half mask", .encoded = {}, .texels = texels, .wrapU = wrap, .wrapV = wrap};
}

// Alpha of that image at texture coordinate u, with linear filtering.
double halfMaskAlpha(double u, scene::Wrap wrap) {
  const double x = 2 * u - 0.5;
  if (x >= 0 && x <= 1) return 1 - x;
  if (wrap == scene::Wrap::kRepeat) return x < 0 ? 1 + x : x - 1;
  return x < 0 ? 1 : 0;
}

TEST(RayTracer, HolesOfAMaskedCardLetPrimaryAndOcclusionRaysThrough) {
  for (const scene::Wrap wrap : {scene::Wrap::kRepeat, scene::Wrap::kClamp, scene::Wrap::kMirror}) {
    SceneBuilder builder;
    builder.scene.textures.push_back(halfMask(wrap));
    // Factor 0.8 and cutoff 0.6: texture alphas below 0.75 are holes.
    const uint32_t card = builder.material({.name = "card",
                                            .baseColor = {1, 1, 1, 0.8f},
                                            .baseColorTexture = 0,
                                            .masked = true,
                                            .alphaCutoff = 0.6f});
    const uint32_t ground = builder.material({});
    builder.place(builder.quad({glm::vec3(0, 1, 0), {1, 1, 0}, {1, 1, -1}, {0, 1, -1}}, card));
    builder.place(builder.floor(glm::vec3(0), 10, ground));
    // Straight down from far above: all rays to the card are practically vertical.
    scene::Camera camera = cameraAt({0.5, 60, -0.5}, {0.5, 0, -0.5}, {0, 0, -1});
    camera.fovyDegrees = 1;
    const RayTracer tracer(builder.scene, camera.eye);
    size_t solid = 0, holes = 0;
    for (const Hit& hit : tracer.castPrimary(camera, 64, 64)) {
      if (hit.viewDepth == 0) continue;
      const double x = hit.position.x;
      const double z = hit.position.z;
      if (x < 0.01 || x > 0.99 || z > -0.01 || z < -0.99) continue;
      const double alpha = halfMaskAlpha(x, wrap);
      if (std::abs(alpha - 0.75) < 0.02) continue;  // the ray is not quite vertical
      EXPECT_EQ(hit.material, alpha > 0.75 ? card : ground) << x;
      ++(alpha > 0.75 ? solid : holes);
    }
    EXPECT_GT(solid, 0u);
    EXPECT_GT(holes, 0u);
  }
}

TEST(RayTracer, OcclusionRaysPassHolesAndAreBlockedByEitherSide) {
  // A lid 0.2 m above the floor, its back face down: opaque, then entirely cut out.
  for (const float alpha : {1.0f, 0.4f}) {
    SceneBuilder builder;
    const uint32_t lid = builder.material(
        {.name = "lid", .baseColor = {1, 1, 1, alpha}, .masked = true, .alphaCutoff = 0.5f});
    builder.place(builder.floor(glm::vec3(0), 100, builder.material({})));
    builder.place(builder.floor(glm::vec3(0, 0.2f, 0), 100, lid));
    const scene::Camera camera = cameraAt({0, 0.1, 0}, {1, 0, 0});
    const RayTracer tracer(builder.scene, camera.eye);
    const auto hits = tracer.castPrimary(camera, 1, 1);
    ASSERT_GT(hits[0].viewDepth, 0);
    const auto visibility = tracer.ambientOcclusion(hits, 0.5, 4096, 1);
    // Rays with cosine >= 0.4 are blocked within 0.5 m: the visible part is 0.4^2 of the
    // cosine-weighted hemisphere.
    EXPECT_NEAR(visibility[0].mean, alpha == 1.0f ? 0.16 : 1.0, 2e-3);
  }
}

TEST(RayTracer, TheNearPlaneCuts) {
  SceneBuilder builder;
  const uint32_t card =
      builder.quad({glm::vec3(-1, -1, 0), {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, builder.material({}));
  builder.place(card, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -0.5)));
  builder.place(card, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -2)));
  scene::Camera camera = cameraAt({0, 0, 0}, {0, 0, -1});
  camera.nearPlane = 1;
  const RayTracer tracer(builder.scene, camera.eye);
  for (const Hit& hit : tracer.castPrimary(camera, 2, 2)) EXPECT_NEAR(hit.viewDepth, 2, 1e-9);
}

}  // namespace
}  // namespace grisaille::trace
