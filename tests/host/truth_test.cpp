// SPDX-License-Identifier: MIT
// Ambient occlusion through the library, against rays in a scene of boxes: for cameras of every
// kind and every convention of depth.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/image/image.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kWidth = 480, kHeight = 320;
constexpr uint32_t kStep = 5;    // of the pixels that rays check, each way
constexpr double kRadius = 0.5;  // metres
constexpr double kNear = 0.25, kFar = 40;

struct Box {
  glm::dvec3 least, most;
};
// A floor, two walls and boxes on the floor, all thick.
constexpr Box kBoxes[] = {{{-9, -1, -9}, {9, 0, 9}},          {{-9, 0, -3}, {9, 6, -2}},
                          {{-3, 0, -9}, {-2, 6, 9}},          {{-1.2, 0, -1}, {-0.3, 1.1, -0.2}},
                          {{0.2, 0, -1.6}, {1.1, 0.5, -0.6}}, {{-0.4, 0, 0.3}, {0.3, 0.35, 0.8}}};

// Where a ray enters and leaves a box, in lengths of the ray; enters > leaves: nowhere.
struct Span {
  glm::dvec3 in, out;

  Span(const Box& box, const glm::dvec3& origin, const glm::dvec3& ray) {
    const glm::dvec3 a = (box.least - origin) / ray, b = (box.most - origin) / ray;
    in = glm::min(a, b);
    out = glm::max(a, b);
  }
  double enters() const { return std::max({in.x, in.y, in.z}); }
  double leaves() const { return std::min({out.x, out.y, out.z}); }
};

Met meetBoxes(const glm::dvec3& origin, const glm::dvec3& ray) {
  Met met;
  for (const Box& box : kBoxes) {
    const Span span(box, origin, ray);
    const double enters = span.enters();
    if (!(enters > 0 && enters < span.leaves() && enters < met.along)) continue;
    const int axis = span.in.x == enters ? 0 : span.in.y == enters ? 1 : 2;
    met.along = enters;
    met.normal = glm::dvec3(0);
    met.normal[axis] = ray[axis] > 0 ? -1 : 1;
  }
  return met;
}

// The nearest surface at or behind the visible one that faces away.
Met meetBacks(const glm::dvec3& origin, const glm::dvec3& ray) {
  const double front = meetBoxes(origin, ray).along;
  Met met;
  for (const Box& box : kBoxes) {
    const Span span(box, origin, ray);
    const double leaves = span.leaves();
    if (span.enters() < leaves && leaves > front) met.along = std::min(met.along, leaves);
  }
  return met;
}

// The nearest surface behind that one that faces the eye.
Met meetNext(const glm::dvec3& origin, const glm::dvec3& ray) {
  const double back = meetBacks(origin, ray).along;
  Met met;
  for (const Box& box : kBoxes) {
    const Span span(box, origin, ray);
    const double enters = span.enters();
    if (enters < span.leaves() && enters > back) met.along = std::min(met.along, enters);
  }
  return met;
}

// What a renderer draws for one camera.
struct Drawn {
  explicit Drawn(const Eye& of)
      : eye(of),
        front(see(of, kWidth, kHeight, meetBoxes)),
        back(see(of, kWidth, kHeight, meetBacks)),
        next(see(of, kWidth, kHeight, meetNext)) {}

  Eye eye;
  Seen front, back, next;
};

// The pixels that rays check.
image::Image sampled(const image::Image& picture) {
  image::Image some{
      .width = kWidth / kStep, .height = kHeight / kStep, .channels = 1, .pixels = {}};
  for (uint32_t y = 0; y < some.height; ++y) {
    for (uint32_t x = 0; x < some.width; ++x)
      some.pixels.push_back(picture.at(x * kStep, y * kStep));
  }
  return some;
}

// Cosine-weighted share of the directions that meet nothing within the radius, at these pixels.
image::Image truthOf(const Drawn& drawn) {
  constexpr int kSide = 12;  // strata of directions, each way
  const Seen& seen = drawn.front;
  const Eye& eye = drawn.eye;
  const glm::dmat4 world = glm::inverse(eye.viewFromWorld);
  image::Image truth{
      .width = kWidth / kStep, .height = kHeight / kStep, .channels = 1, .pixels = {}};
  for (size_t at = 0; at < size_t{truth.width} * truth.height; ++at) {
    const size_t i = at / truth.width * kStep * kWidth + at % truth.width * kStep;
    if (seen.view[i] == 0) {
      truth.pixels.push_back(1);
      continue;
    }
    const glm::dvec3 n = seen.normal[i];
    const glm::dvec3 place = glm::dvec3(world * glm::dvec4(placeOf(eye, seen, i), 1)) + 1e-6 * n;
    const glm::dvec3 right = std::abs(n.y) > 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 up = glm::cross(n, right);
    int open = 0;
    for (int k = 0; k < kSide * kSide; ++k) {
      const double u = (k % kSide + 0.5) / kSide;
      const double phi = 2 * std::numbers::pi * (k / kSide + 0.5) / kSide;
      const double r = std::sqrt(u);
      const glm::dvec3 way =
          r * std::cos(phi) * right + r * std::sin(phi) * up + std::sqrt(1 - u) * n;
      open += meetBoxes(place, way + 1e-9).along > kRadius ? 1 : 0;
    }
    truth.pixels.push_back(static_cast<float>(open) / (kSide * kSide));
  }
  return truth;
}

struct Way {
  grisaille_host_depth depth = GRISAILLE_HOST_DEPTH_BUFFER;
  Clip clip;
};

std::vector<Way> everyWay() {
  std::vector<Way> ways = {{.depth = GRISAILLE_HOST_DEPTH_VIEW, .clip = {kNear, kFar}},
                           {.depth = GRISAILLE_HOST_DEPTH_DISTANCE, .clip = {kNear, kFar}}};
  for (const bool reversed : {false, true}) {
    for (const bool fromMinusOne : {false, true}) {
      ways.push_back({.clip = {kNear, kFar, reversed, fromMinusOne}});
    }
  }
  ways.push_back({.clip = {kNear, 0, true, false}});
  return ways;
}

const glm::dvec3 kTarget(-0.3, 0.4, -0.5), kBackward = glm::normalize(glm::dvec3(1.4, 1.5, 2.2));

glm::dmat4 viewFrom(double metres) {
  return glm::lookAt(kTarget + metres * kBackward, kTarget, glm::dvec3(0, 1, 0));
}

class Truth : public ::testing::TestWithParam<TestDevice> {
 protected:
  Truth() : host_(makeHost(GetParam())), device_(host_->device()) {}
  ~Truth() override { EXPECT_EQ(host_->complaints(), 0); }

  image::Image visibility(const Drawn& drawn, const Way& way) {
    const Eye& eye = drawn.eye;
    const Seen& seen = drawn.front;
    const glm::dmat4 projection = projectionOf(eye, double{1} * kWidth / kHeight, way.clip);
    const auto depthOf = [&](const Seen& of, size_t i) {
      return depthValue(of, i, way.depth, way.clip, projection);
    };
    std::vector<float> depths, backs, nexts, normals;
    for (size_t i = 0; i < seen.view.size(); ++i) {
      depths.push_back(depthOf(seen, i));
      backs.push_back(depthOf(drawn.back, i));
      nexts.push_back(depthOf(drawn.next, i));
      for (int k = 0; k < 3; ++k) normals.push_back(static_cast<float>(seen.normal[i][k]));
      normals.push_back(0);
    }
    const auto depth = host_->texture(device_, Texels::kFloat1, kWidth, kHeight, depths);
    const auto next = host_->texture(device_, Texels::kFloat1, kWidth, kHeight, nexts);
    const auto back = host_->texture(device_, Texels::kFloat1, kWidth, kHeight, backs);
    const auto normal = host_->texture(device_, Texels::kFloat4, kWidth, kHeight, normals);
    host::Effect effect(device_, {.effect = "ssao", .width = kWidth, .height = kHeight});
    effect.set("radius", kRadius);
    effect.set("backs", "peeled");
    const host::Camera camera = cameraOf(eye, projection, way.clip);
    host_->frame([&](void* commands, uint64_t number) {
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = camera,
                     .depth = depth,
                     .depthKind = way.depth,
                     .normal = &normal,
                     .backDepth = &back,
                     .nextDepth = &next});
    });
    return {.width = kWidth,
            .height = kHeight,
            .channels = 1,
            .pixels = host_->read(effect.output("ao"))};
  }

  std::unique_ptr<Host> host_;
  host::Device device_;
};
GRISAILLE_IN_EVERY_HOST(Truth);

constexpr double kTall = 3.2;  // metres of the scene that the height spans

struct Kind {
  const char* name;
  Eye eye;
};
std::vector<Kind> kinds() {
  const Eye perspective{.viewFromWorld = viewFrom(4.5), .angle = 2 * std::atan(kTall / 2 / 4.5)};
  const Eye orthographic{.viewFromWorld = viewFrom(4.5), .height = kTall};
  std::vector<Kind> all = {{"perspective", perspective}, {"orthographic", orthographic}};
  for (const Eye& eye : {perspective, orthographic}) {
    const char* name = eye.angle > 0 ? "perspective" : "orthographic";
    all.push_back({name, eye});
    all.back().eye.shift = {0.35, -0.2};  // off-centre
    all.push_back({name, eye});
    all.back().eye.shift = {0.4 / kWidth, -0.3 / kHeight};  // jitter
  }
  return all;
}

TEST_P(Truth, EveryCameraAndEveryDepthAgreesWithRays) {
  for (const Kind& kind : kinds()) {
    const Drawn drawn(kind.eye);
    const image::Image truth = truthOf(drawn);
    double worst = 0;
    for (const Way& way : everyWay()) {
      if (kind.eye.angle == 0 && way.clip.far == 0) continue;
      const double rmse = image::compare(sampled(visibility(drawn, way)), truth).rmse;
      EXPECT_LE(rmse, 0.035) << kind.name << ", shift " << kind.eye.shift.x << ", depth kind "
                             << way.depth << ", reversed " << way.clip.reversed << ", from -1 "
                             << way.clip.fromMinusOne;
      worst = std::max(worst, rmse);
    }
    std::printf("%s, shift %.4f: RMSE at most %.4f\n", kind.name, kind.eye.shift.x, worst);
  }
}

// Perspective rays from 2,000 m are parallel to a part in 1,000.
TEST_P(Truth, OrthographicIsPerspectiveFromAfar) {
  constexpr double kAway = 2000;
  const Eye far{.viewFromWorld = viewFrom(kAway), .angle = 2 * std::atan(kTall / 2 / kAway)};
  const Eye near{.viewFromWorld = viewFrom(4.5), .height = kTall};
  const Way metres = {.depth = GRISAILLE_HOST_DEPTH_VIEW, .clip = {kNear, 0}};
  const Way buffer = {.clip = {kNear, kFar, true}};
  const image::Difference difference =
      image::compare(visibility(Drawn(near), buffer), visibility(Drawn(far), metres));
  std::printf("orthographic against perspective from %g m: RMSE %.5f\n", kAway, difference.rmse);
  EXPECT_LE(difference.rmse, 0.003);
}

}  // namespace
}  // namespace grisaille::tests
