// SPDX-License-Identifier: MIT
// Cameras from the matrices in picture files, in the conventions of several renderers.
#include "core/scene/camera_matrices.h"
#include "core/scene/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/expect_error.h"

namespace grisaille::scene {
namespace {

constexpr uint32_t kWidth = 1920, kHeight = 1081;

std::array<float, 16> rows(const glm::dmat4& matrix) {
  std::array<float, 16> all;
  for (int i = 0; i < 16; ++i)
    all[static_cast<size_t>(i)] = static_cast<float>(matrix[i / 4][i % 4]);
  return all;
}

glm::dmat4 matrix(const std::array<float, 16>& rows) {
  glm::dmat4 all;
  for (int i = 0; i < 16; ++i) all[i / 4][i % 4] = double{rows[static_cast<size_t>(i)]};
  return all;
}

const Camera kCamera{
    .eye = {3, 2.5, -1}, .target = {-2, 1, 4}, .up = {0.1, 1, 0.2}, .fovyDegrees = 48};

Camera shifted(Camera camera, double x, double y) {
  camera.shift = {x, y};
  return camera;
}
Camera orthographic(Camera camera) {
  camera.orthographicHeight = 7;
  return camera;
}
// Centred, jittered, for one eye of a headset, a corner of a larger picture, and orthographic.
std::vector<Camera> kinds() {
  return {kCamera,
          shifted(kCamera, 0.4 / kWidth, -0.3 / kHeight),
          shifted(kCamera, -0.11, 0.02),
          shifted(kCamera, 0.5, 0.5),
          shifted(kCamera, -0.5, -0.5),
          orthographic(kCamera),
          orthographic(shifted(kCamera, 0.2, -0.35))};
}

void expectSame(const Camera& camera, const Camera& expected) {
  for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1234, 77), glm::dvec2(1920, 1081)}) {
    const ViewRay a = rayAt(viewOf(camera, {kWidth, kHeight}), at);
    const ViewRay b = rayAt(viewOf(expected, {kWidth, kHeight}), at);
    EXPECT_LT(glm::length(a.direction - b.direction), 3e-6);
    EXPECT_LT(glm::length(a.origin - b.origin), 1e-5);
  }
  EXPECT_LT(glm::length(camera.eye - expected.eye), 1e-5);
}

Camera back(const image::ViewMatrices& matrices) {
  return cameraOf(matrices, kWidth, kHeight, "test");
}

TEST(CameraMatrices, ComeBackToTheCamera) {
  for (const Camera& camera : kinds()) {
    SCOPED_TRACE(cameraJson(camera));
    expectSame(back(matricesOf(camera, kWidth, kHeight)), camera);
  }
  const Camera other{.eye = {-1e3, 20, 5e2}, .target = {-999, 19.5, 500}, .fovyDegrees = 100};
  const Camera read = back(matricesOf(other, kWidth, kHeight));
  EXPECT_LT(glm::length(read.eye - other.eye), 1e-3);  // within the precision of floats
  EXPECT_NEAR(read.fovyDegrees, 100, 1e-3);
}

// A camera that looks along +z, as in RenderMan, with NDC from 0 at the top left corner to 1.
TEST(CameraMatrices, OtherConventionsAreUnderstood) {
  const Camera jittered = shifted(kCamera, 0.4 / kWidth, -0.3 / kHeight);
  for (const Camera& camera : {kCamera, jittered, orthographic(kCamera), orthographic(jittered)}) {
    SCOPED_TRACE(cameraJson(camera));
    const image::ViewMatrices own = matricesOf(camera, kWidth, kHeight);
    const glm::dmat4 flipZ = glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1));
    const glm::dmat4 fromCorner = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.5, 0)) *
                                  glm::scale(glm::dmat4(1), glm::dvec3(0.5, -0.5, 1));
    const auto view = rows(flipZ * matrix(own.worldToCamera));
    const auto ndc = rows(fromCorner * matrix(own.worldToNdc));
    expectSame(back({own.worldToCamera, ndc}), camera);
    expectSame(back({view, own.worldToNdc}), camera);
    expectSame(back({view, ndc}), camera);
    // Scaling a projection matrix does not change the projection.
    expectSame(back({view, rows(glm::dmat4(matrix(ndc)) * 7.0)}), camera);
  }
}

TEST(CameraMatrices, WhatIsNoCameraOfThePictureIsRefused) {
  const image::ViewMatrices own = matricesOf(kCamera, kWidth, kHeight);
  const glm::dmat4 view = matrix(own.worldToCamera), ndc = matrix(own.worldToNdc);
  const auto refused = [](const image::ViewMatrices& matrices) {
    EXPECT_ERROR(ErrorId::kPictureMatrices, back(matrices));
  };
  refused({});
  refused({rows(glm::dmat4(0)), own.worldToNdc});
  refused({own.worldToCamera, rows(glm::ortho(-1.0, 1.0, -1.0, 1.0) * view)});
  const auto ndcThen = [&](const glm::dmat4& then) {
    return image::ViewMatrices{own.worldToCamera, rows(then * ndc)};
  };
  // Off centre, so that NDC may begin at -1 or at 0.
  refused(ndcThen(glm::translate(glm::dmat4(1), glm::dvec3(0.6, 0.3, 0))));
  refused(ndcThen(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1))));   // mirrored
  refused(ndcThen(glm::scale(glm::dmat4(1), glm::dvec3(1.1, 1, 1))));  // stretched
  const auto ortho = rows(matrix(matricesOf(orthographic(kCamera), kWidth, kHeight).worldToNdc));
  refused({rows(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)) * view), ortho});  // mirrored
  refused(
      {own.worldToCamera, rows(glm::scale(glm::dmat4(1), glm::dvec3(1.1, 1, 1)) * matrix(ortho))});
  // The matrix of another camera.
  refused({matricesOf({.eye = {0, 0, 9}}, kWidth, kHeight).worldToCamera, own.worldToNdc});
  image::ViewMatrices odd = own;
  odd.worldToCamera[5] = std::nanf("");
  refused(odd);
  odd = own;
  odd.worldToNdc[0] = std::nanf("");
  refused(odd);
  EXPECT_ERROR(ErrorId::kPictureMatrices, cameraOf(own, 100, 100, "test"));
}

}  // namespace
}  // namespace grisaille::scene
