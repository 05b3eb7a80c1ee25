// SPDX-License-Identifier: MIT
// All conventions for a host's depth and normals give the same picture.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kWidth = 96, kHeight = 64;
constexpr double kNear = 0.25, kFar = 12, kAngle = 0.8;

// A host's conventions for its inputs.
struct Way {
  const char* name;
  grisaille_host_depth depth = GRISAILLE_HOST_DEPTH_VIEW;
  Texels depthTexels = Texels::kFloat1;
  double far = 0;  // metres; 0: none
  bool normals = true;
  grisaille_host_normals space = GRISAILLE_HOST_NORMALS_WORLD;
  grisaille_host_encoding encoding = GRISAILLE_HOST_SIGNED;
  grisaille_host_rows rows = GRISAILLE_HOST_ROWS_FROM_TOP;
};

Eye pinhole() {
  return {.viewFromWorld = glm::lookAt(glm::dvec3(1.2, 1.6, 3.1), glm::dvec3(0.1, 0.5, -0.3),
                                       glm::dvec3(0, 1, 0)),
          .angle = kAngle};
}

std::vector<float> turned(const std::vector<float>& numbers, const Seen& seen,
                          grisaille_host_rows rows) {
  if (rows == GRISAILLE_HOST_ROWS_FROM_TOP) return numbers;
  const size_t row = numbers.size() / seen.height;
  std::vector<float> result;
  for (size_t y = seen.height; y > 0; --y) {
    result.insert(result.end(), numbers.begin() + static_cast<ptrdiff_t>((y - 1) * row),
                  numbers.begin() + static_cast<ptrdiff_t>(y * row));
  }
  return result;
}

std::vector<float> depthOf(const Seen& seen, const Way& way, bool orthographic) {
  std::vector<float> numbers;
  for (size_t i = 0; i < seen.view.size(); ++i) {
    const double z = seen.view[i], far = way.far;
    double reversed = 0;
    if (z > 0 && orthographic) reversed = (far - z) / (far - kNear);
    if (z > 0 && !orthographic) {
      reversed = far == 0 ? kNear / z : kNear * (far - z) / (z * (far - kNear));
    }
    const double value = way.depth == GRISAILLE_HOST_DEPTH_VIEW            ? z
                         : way.depth == GRISAILLE_HOST_DEPTH_DISTANCE      ? seen.distance[i]
                         : way.depth == GRISAILLE_HOST_DEPTH_CLIP_REVERSED ? reversed
                                                                           : 1 - reversed;
    numbers.push_back(static_cast<float>(value));
  }
  return turned(numbers, seen, way.rows);
}

std::vector<float> normalsOf(const Seen& seen, const Way& way, const Eye& eye) {
  std::vector<float> numbers;
  for (const glm::dvec3& world : seen.normal) {
    glm::dvec3 normal = world;
    if (way.space == GRISAILLE_HOST_NORMALS_VIEW) normal = glm::dmat3(eye.viewFromWorld) * normal;
    if (way.encoding == GRISAILLE_HOST_UNSIGNED) normal = (normal + 1.0) / 2.0;
    for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(normal[i]));
    numbers.push_back(0);
  }
  return turned(numbers, seen, way.rows);
}

class Conventions : public ::testing::TestWithParam<TestDevice> {
 protected:
  Conventions() : host_(makeHost(GetParam())), device_(host_->device()) {}
  ~Conventions() override { EXPECT_EQ(host_->complaints(), 0); }

  // Renders ambient occlusion; returns rows from the top.
  image::Image visibility(const Eye& eye, const Way& way) {
    const Seen seen = see(eye, kWidth, kHeight);
    const bool orthographic = eye.angle == 0;
    const auto depth =
        host_->texture(device_, way.depthTexels, kWidth, kHeight, depthOf(seen, way, orthographic));
    const auto normal =
        host_->texture(device_, Texels::kFloat4, kWidth, kHeight, normalsOf(seen, way, eye));
    host::Effect effect(device_,
                        {.effect = "ssao", .width = kWidth, .height = kHeight, .rows = way.rows});
    effect.set("radius", 0.6);
    const double* view = &eye.viewFromWorld[0][0];
    const host::Camera camera = orthographic
                                    ? host::Camera::orthographic(view, eye.height, kNear, way.far)
                                    : host::Camera::pinhole(view, eye.angle, kNear, way.far);
    host_->frame([&](void* commands, uint64_t number) {
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = camera,
                     .depth = depth,
                     .depthKind = way.depth,
                     .normal = way.normals ? &normal : nullptr,
                     .normalSpace = way.space,
                     .normalEncoding = way.encoding});
    });
    return {.width = kWidth,
            .height = kHeight,
            .channels = 1,
            .pixels = turned(host_->read(effect.output("ao")), seen, way.rows)};
  }

  static double share(const image::Image& a, const image::Image& b) {
    return image::shareOver(a, b, 1.0 / 255);
  }

  std::unique_ptr<Host> host_;
  host::Device device_;
};
GRISAILLE_IN_EVERY_HOST(Conventions);

TEST_P(Conventions, AllComeToTheSame) {
  const image::Image expected = visibility(pinhole(), {.name = "metres"});
  image::Image open = expected;
  std::ranges::fill(open.pixels, 1.0f);
  EXPECT_GT(image::shareOver(expected, open, 0.2), 0.05) << "no pixel is occluded";
  constexpr auto kReversed = GRISAILLE_HOST_DEPTH_CLIP_REVERSED;
  const Way ways[] = {{.name = "reversed, infinite", .depth = kReversed},
                      {.name = "reversed, finite", .depth = kReversed, .far = kFar},
                      {.name = "infinite", .depth = GRISAILLE_HOST_DEPTH_CLIP},
                      {.name = "finite", .depth = GRISAILLE_HOST_DEPTH_CLIP, .far = kFar},
                      {.name = "distance", .depth = GRISAILLE_HOST_DEPTH_DISTANCE},
                      {.name = "depth and stencil",
                       .depth = GRISAILLE_HOST_DEPTH_CLIP,
                       .depthTexels = Texels::kDepth24,
                       .far = kFar},
                      {.name = "normals in view space", .space = GRISAILLE_HOST_NORMALS_VIEW},
                      {.name = "normals from 0 to 1", .encoding = GRISAILLE_HOST_UNSIGNED},
                      {.name = "rows from the bottom",
                       .depth = kReversed,
                       .far = kFar,
                       .space = GRISAILLE_HOST_NORMALS_VIEW,
                       .encoding = GRISAILLE_HOST_UNSIGNED,
                       .rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM}};
  for (const Way& way : ways) {
    const image::Image found = visibility(pinhole(), way);
    EXPECT_EQ(share(found, expected), 0)
        << way.name << " " << image::compare(found, expected).largest;
  }
}

// Same result as `grisaille apply` on the depth alone.
TEST_P(Conventions, WithoutNormalsThoseOfTheFacetsAreTaken) {
  const Eye eye = pinhole();
  const Seen seen = see(eye, kWidth, kHeight);
  const TemporaryFolder folder;
  image::write({.width = kWidth,
                .height = kHeight,
                .channels = 1,
                .pixels = {seen.view.begin(), seen.view.end()}},
               folder / "depth.exr");
  scene::Camera camera;
  camera.eye = glm::dvec3(1.2, 1.6, 3.1);
  camera.target = glm::dvec3(0.1, 0.5, -0.3);
  camera.fovyDegrees = glm::degrees(kAngle);
  camera.nearPlane = kNear;
  const Outcome outcome =
      runProgram({"apply", "--depth", "depth.exr", "--camera", scene::cameraJson(camera), "--set",
                  "ssao.radius=0.6", "--backend", GetParam().backend, "--write", "ao=ao.exr"},
                 folder.path(), driverEnvironment(GetParam()));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const image::Image expected = image::read(folder / "ao.exr");
  // Where two triples of pixels fit a line equally well, rounding decides.
  const image::Image found = visibility(eye, {.name = "facets", .normals = false});
  EXPECT_LT(share(found, expected), 0.002);
  const image::Image turned = visibility(
      eye, {.name = "turned", .normals = false, .rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM});
  EXPECT_EQ(share(turned, found), 0);
}

// An orthographic camera gives the picture of a pinhole very far away.
TEST_P(Conventions, OrthographicIsAPinholeFromFarAway) {
  const glm::dvec3 target(0.1, 0.5, -0.3), backward = glm::normalize(glm::dvec3(1.1, 1.1, 3.4));
  const auto from = [&](double metres) {
    return glm::lookAt(target + metres * backward, target, glm::dvec3(0, 1, 0));
  };
  constexpr double kTall = 3, kFarAway = 150;  // metres
  const Eye far = {.viewFromWorld = from(kFarAway), .angle = 2 * std::atan(kTall / 2 / kFarAway)};
  const Eye near = {.viewFromWorld = from(4), .height = kTall};
  const image::Image expected = visibility(far, {.name = "far"});
  for (const bool reversed : {true, false}) {
    for (const bool normals : {true, false}) {
      const Way way = {
          .name = "orthographic",
          .depth = reversed ? GRISAILLE_HOST_DEPTH_CLIP_REVERSED : GRISAILLE_HOST_DEPTH_CLIP,
          .far = 9,
          .normals = normals};
      const image::Image found = visibility(near, way);
      const image::Difference difference = image::compare(found, expected);
      EXPECT_LT(difference.rmse, normals ? 0.01 : 0.02) << reversed << normals;
      EXPECT_LT(std::abs(difference.bias), 0.003) << reversed << normals;
    }
  }
  const Way metres = {.name = "metres", .far = 9};
  EXPECT_LT(image::compare(visibility(near, metres), expected).rmse, 0.01);
}

}  // namespace
}  // namespace grisaille::tests
