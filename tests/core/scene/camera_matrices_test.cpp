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

void expectSame(const Camera& camera, const Camera& expected) {
  for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1234, 77), glm::dvec2(1920, 1081)}) {
    const glm::dvec3 a = rayAt(viewOf(camera, {kWidth, kHeight}), at).direction;
    const glm::dvec3 b = rayAt(viewOf(expected, {kWidth, kHeight}), at).direction;
    EXPECT_LT(glm::length(a - b), 3e-6);
  }
  EXPECT_LT(glm::length(camera.eye - expected.eye), 1e-5);
}

Camera back(const image::ViewMatrices& matrices) {
  return cameraOf(matrices, kWidth, kHeight, "test");
}

TEST(CameraMatrices, ComeBackToTheCamera) {
  expectSame(back(matricesOf(kCamera, kWidth, kHeight)), kCamera);
  const Camera other{.eye = {-1e3, 20, 5e2}, .target = {-999, 19.5, 500}, .fovyDegrees = 100};
  const Camera read = back(matricesOf(other, kWidth, kHeight));
  EXPECT_LT(glm::length(read.eye - other.eye), 1e-3);  // within the precision of floats
  EXPECT_NEAR(read.fovyDegrees, 100, 1e-3);
}

// A camera that looks along +z, as in RenderMan, with NDC from 0 at the top left corner to 1.
TEST(CameraMatrices, OtherConventionsAreUnderstood) {
  const image::ViewMatrices own = matricesOf(kCamera, kWidth, kHeight);
  const glm::dmat4 flipZ = glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1));
  const glm::dmat4 fromCorner = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.5, 0)) *
                                glm::scale(glm::dmat4(1), glm::dvec3(0.5, -0.5, 1));
  const auto view = rows(flipZ * matrix(own.worldToCamera));
  const auto ndc = rows(fromCorner * matrix(own.worldToNdc));
  expectSame(back({own.worldToCamera, ndc}), kCamera);
  expectSame(back({view, own.worldToNdc}), kCamera);
  expectSame(back({view, ndc}), kCamera);
  // Scaling a projection matrix does not change the projection.
  expectSame(back({view, rows(glm::dmat4(matrix(ndc)) * 7.0)}), kCamera);
}

TEST(CameraMatrices, WhatIsNoPinholeOfThePictureIsRefused) {
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
  refused(ndcThen(glm::translate(glm::dmat4(1), glm::dvec3(0.1, 0, 0))));  // off centre
  refused(ndcThen(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1))));       // mirrored
  refused(ndcThen(glm::scale(glm::dmat4(1), glm::dvec3(1.1, 1, 1))));      // stretched
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
