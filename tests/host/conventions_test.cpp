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
  Clip clip = {.near = kNear};
  bool clipYDown = false;  // as many Vulkan renderers have it
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

// What a depth buffer holds, from the projection that drew it from `nearer` metres nearer.
std::vector<float> depthOf(const Seen& seen, const Way& way, const glm::dmat4& projection,
                           double nearer) {
  std::vector<float> numbers;
  for (size_t i = 0; i < seen.view.size(); ++i) {
    numbers.push_back(depthValue(seen, i, way.depth, way.clip, projection, nearer));
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
  // `given`: what the eye sees, from `nearer` metres further back; null: traced.
  image::Image visibility(const Eye& eye, const Way& way, const Seen* given = nullptr,
                          double nearer = 0) {
    const Seen seen = given != nullptr ? *given : see(eye, kWidth, kHeight);
    glm::dmat4 projection = projectionOf(eye, double{1} * kWidth / kHeight, way.clip);
    const auto depth = host_->texture(device_, way.depthTexels, kWidth, kHeight,
                                      depthOf(seen, way, projection, nearer));
    const auto normal =
        host_->texture(device_, Texels::kFloat4, kWidth, kHeight, normalsOf(seen, way, eye));
    host::Effect effect(device_,
                        {.effect = "ssao", .width = kWidth, .height = kHeight, .rows = way.rows});
    effect.set("radius", 0.6);
    if (way.clipYDown) {
      for (int column = 0; column < 4; ++column) projection[column][1] *= -1;
    }
    const host::Camera camera = cameraOf(eye, projection, way.clip);
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

const Clip kInfinite = {.near = kNear}, kFinite = {.near = kNear, .far = kFar};

std::vector<Way> everyWay() {
  constexpr auto kBuffer = GRISAILLE_HOST_DEPTH_BUFFER;
  std::vector<Way> ways;
  for (const bool reversed : {false, true}) {
    for (const bool fromMinusOne : {false, true}) {
      for (const bool finite : {false, true}) {
        Clip clip = finite ? kFinite : kInfinite;
        clip.reversed = reversed;
        clip.fromMinusOne = fromMinusOne;
        ways.push_back({.name = "buffer", .depth = kBuffer, .clip = clip});
      }
    }
  }
  ways.push_back({.name = "distance", .depth = GRISAILLE_HOST_DEPTH_DISTANCE});
  ways.push_back({.name = "metres, planes from -1 to 1",
                  .clip = {.near = kNear, .far = kFar, .fromMinusOne = true}});
  ways.push_back({.name = "depth and stencil",
                  .depth = kBuffer,
                  .depthTexels = Texels::kDepth32Stencil,
                  .clip = kFinite});
  ways.push_back({.name = "clip y down", .depth = kBuffer, .clip = kFinite, .clipYDown = true});
  ways.push_back({.name = "normals in view space", .space = GRISAILLE_HOST_NORMALS_VIEW});
  ways.push_back({.name = "normals from 0 to 1", .encoding = GRISAILLE_HOST_UNSIGNED});
  ways.push_back({.name = "rows from the bottom",
                  .depth = kBuffer,
                  .clip = {.near = kNear, .far = kFar, .reversed = true},
                  .space = GRISAILLE_HOST_NORMALS_VIEW,
                  .encoding = GRISAILLE_HOST_UNSIGNED,
                  .rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM});
  return ways;
}

// For cameras of every kind.
TEST_P(Conventions, AllComeToTheSame) {
  Eye eccentric = pinhole(), parallel = pinhole();
  eccentric.shift = {0.2, -0.15};
  parallel.angle = 0;
  parallel.height = 3;
  parallel.shift = {0.1, 0.05};
  for (const Eye& eye : {pinhole(), eccentric, parallel}) {
    const Way metres = {.name = "metres", .clip = eye.angle > 0 ? kInfinite : kFinite};
    const image::Image expected = visibility(eye, metres);
    image::Image open = expected;
    std::ranges::fill(open.pixels, 1.0f);
    EXPECT_GT(image::shareOver(expected, open, 0.2), 0.03) << "no pixel is occluded";
    for (const Way& way : everyWay()) {
      Way own = way;
      if (eye.angle == 0) own.clip.far = kFar;
      const image::Image found = visibility(eye, own);
      // Depth buffers round depth, which moves a few taps to other pixels.
      EXPECT_LE(share(found, expected), 0.001)
          << way.name << (way.clip.reversed ? ", reversed" : "")
          << (way.clip.fromMinusOne ? ", from -1" : "") << (own.clip.far > 0 ? ", finite" : "")
          << ", angle " << eye.angle << ": " << image::compare(found, expected).largest;
    }
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

// An orthographic camera's near plane may lie behind its eye.
TEST_P(Conventions, AnOrthographicEyeMayStandInTheScene) {
  Eye outside = pinhole();
  outside.angle = 0;
  outside.height = 3;
  Eye inside = outside;
  inside.viewFromWorld = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 6)) * outside.viewFromWorld;
  const auto way = [](double near, double far, grisaille_host_depth depth) {
    return Way{.name = "orthographic", .depth = depth, .clip = {.near = near, .far = far}};
  };
  const image::Image expected = visibility(outside, way(kNear, kFar, GRISAILLE_HOST_DEPTH_BUFFER));
  // The inner eye sees what lies behind it: its pictures have the outer one's values, moved.
  const Seen seen = see(outside, kWidth, kHeight);
  const image::Image found =
      visibility(inside, way(kNear - 6, kFar - 6, GRISAILLE_HOST_DEPTH_BUFFER), &seen, 6);
  EXPECT_LE(share(found, expected), 0.001) << image::compare(found, expected).largest;
}

}  // namespace
}  // namespace grisaille::tests
