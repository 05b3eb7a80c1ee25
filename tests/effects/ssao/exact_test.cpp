// SPDX-License-Identifier: MIT
// Slices against the exact visibility of a floor under a box, a sphere, a sheet and a lattice: what
// a segment of matter is when its front and its back are known, see docs/design/ssao.md.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <span>

#include "tests/effects/ssao/render_ao.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"
#include "tests/support/test_device.h"

namespace grisaille::frame {
namespace {

constexpr double kReach = 0.5;  // the effect's radius, metres

struct Aabb {
  glm::dvec3 least, most;
};

// An object over the floor y = 0.
struct Object {
  const char* name;
  scene::Scene scene;
  // Whether a ray from a point of the floor hits it at most kReach away.
  std::function<bool(const glm::dvec3& from, const glm::dvec3& unit)> hit;
  // The RMSE that may be left: with the mean thickness of bodies and 24 taps, and with drawn backs
  // and 48 taps. A third above what was measured.
  double bodies = 0, drawn = 0;
};

bool hitsAabb(const Aabb& box, const glm::dvec3& from, const glm::dvec3& unit) {
  double enter = 0, leave = kReach;
  for (int axis = 0; axis < 3; ++axis) {
    const double one = (box.least[axis] - from[axis]) / unit[axis];
    const double two = (box.most[axis] - from[axis]) / unit[axis];
    enter = std::max(enter, std::min(one, two));
    leave = std::min(leave, std::max(one, two));
  }
  return enter <= leave;
}

Object boxes(const char* name, const std::vector<Aabb>& all) {
  Object object = {.name = name, .scene = tests::floorScene(), .hit = {}};
  for (const Aabb& one : all) {
    // Without a transform: a body's mean thickness counts before its instance's.
    const size_t first = object.scene.positions.size();
    tests::addBox(object.scene, glm::dmat4(1));
    for (glm::vec3& corner : std::span(object.scene.positions).subspan(first)) {
      corner = glm::vec3(glm::mix(one.least, one.most, (glm::dvec3(corner) + 1.0) / 2.0));
    }
  }
  scene::computeBounds(object.scene);
  object.hit = [all](const glm::dvec3& from, const glm::dvec3& unit) {
    return std::ranges::any_of(all, [&](const Aabb& one) { return hitsAabb(one, from, unit); });
  };
  return object;
}

Object sphere() {
  constexpr double kSize = 0.22;
  constexpr glm::dvec3 kCentre(0, 0.27, 0);
  constexpr uint32_t kAround = 64, kRings = 32;
  Object object = {.name = "sphere", .scene = tests::floorScene(), .hit = {}};
  const auto out = [](uint32_t ring, uint32_t step) {
    const double down = std::numbers::pi * ring / kRings;
    const double turn = 2 * std::numbers::pi * (step % kAround) / kAround;
    return glm::dvec3(std::sin(down) * std::sin(turn), std::cos(down),
                      std::sin(down) * std::cos(turn));
  };
  for (uint32_t ring = 0; ring < kRings; ++ring) {
    for (uint32_t step = 0; step < kAround; ++step) {
      std::array<glm::vec3, 4> corners;
      size_t k = 0;
      for (const glm::dvec3& unit :
           {out(ring + 1, step), out(ring + 1, step + 1), out(ring, step + 1), out(ring, step)}) {
        corners[k++] = glm::vec3(kCentre + kSize * unit);
      }
      tests::addQuad(object.scene, corners,
                     glm::vec3(glm::normalize(out(ring, step) + out(ring + 1, step + 1))));
    }
  }
  object.hit = [=](const glm::dvec3& from, const glm::dvec3& unit) {
    const double along = glm::dot(kCentre - from, unit);
    const double off = glm::dot(kCentre - from, kCentre - from) - along * along;
    const double half = std::sqrt(std::max(kSize * kSize - off, 0.0));
    return off < kSize * kSize && along + half > 0 && along - half < kReach;
  };
  return object;
}

Object sheet() {
  constexpr double kSize = 0.3, kHeight = 0.22;
  Object object = {.name = "sheet", .scene = tests::floorScene(), .hit = {}};
  object.scene.materials.push_back({.name = "sheet", .doubleSided = true});
  const auto s = static_cast<float>(kSize), h = static_cast<float>(kHeight);
  tests::addQuad(object.scene, {glm::vec3(-s, h, s), {s, h, s}, {s, h, -s}, {-s, h, -s}}, {0, 1, 0},
                 1);
  object.hit = [](const glm::dvec3& from, const glm::dvec3& unit) {
    const double t = (kHeight - from.y) / unit.y;
    const glm::dvec3 at = from + t * unit;
    return t < kReach && std::abs(at.x) < kSize && std::abs(at.z) < kSize;
  };
  return object;
}

std::vector<Object> objects() {
  std::vector<Aabb> bars;
  for (int i = -4; i <= 4; ++i) {
    bars.push_back({{0.1 * i - 0.015, 0.2, -0.4}, {0.1 * i + 0.015, 0.23, 0.4}});
  }
  std::vector<Object> all;
  const auto add = [&](Object object, double bodies, double drawn) {
    object.bodies = bodies;
    object.drawn = drawn;
    all.push_back(std::move(object));
  };
  add(boxes("box", {{{-0.15, 0, -0.15}, {0.15, 0.35, 0.15}}}), 0.028, 0.015);
  add(sphere(), 0.044, 0.018);
  add(sheet(), 0.026, 0.023);
  add(boxes("lattice", bars), 0.075, 0.045);
  return all;
}

struct Errors {
  double rmse = 0, mean = 0;
};

class ExactTest : public tests::BackendTest {
 protected:
  static constexpr uint32_t kWide = 320, kTall = 240, kEvery = 6;  // pixels

  // Of the floor within 0.8 m of the object, where the object does not hide it.
  std::vector<Errors> errorsOf(const Object& object, const std::vector<tests::Settings>& settings) {
    const scene::Camera camera = {.eye = glm::dvec3(0.5, 0.9, 1.5),
                                  .target = glm::dvec3(0, 0.1, 0)};
    std::vector<image::Image> shown;
    image::Image depth;
    for (const tests::Settings& one : settings) {
      tests::AoFrames frames(device(), object.scene, one);
      std::vector<image::Image> both = frames.showAll(camera, kWide, kTall, {"ao", "depth"});
      shown.push_back(std::move(both[0]));
      depth = std::move(both[1]);
    }
    std::vector<Errors> errors(settings.size());
    int count = 0;
    for (uint32_t y = 3; y < kTall; y += kEvery) {
      for (uint32_t x = 3; x < kWide; x += kEvery) {
        const glm::dvec3 point = tests::surfaceAt(camera, depth, x, y);
        if (depth.at(x, y) == 0 || std::abs(point.y) > 1e-3) continue;
        if (std::max(std::abs(point.x), std::abs(point.z)) > 0.8) continue;
        const double right = tests::tracedVisibility({0, 1, 0}, 2000, [&](const glm::dvec3& ray) {
          return object.hit({point.x, 0, point.z}, ray);
        });
        for (size_t i = 0; i < settings.size(); ++i) {
          const double off = shown[i].at(x, y) - right;
          errors[i].rmse += off * off;
          errors[i].mean += off;
        }
        ++count;
      }
    }
    EXPECT_GE(count, 300) << object.name;
    for (Errors& one : errors) one = {std::sqrt(one.rmse / count), one.mean / count};
    return errors;
  }
};
GRISAILLE_ON_EVERY_DEVICE(ExactTest);

TEST_P(ExactTest, KnowingMoreOfTheMatterErrsLess) {
  const auto setting = [](const char* backs, const char* thickness, const char* taps) {
    return tests::Settings{{"radius", "0.5"},      {"backs", backs},  {"thickness", thickness},
                           {"kernel_size", taps},  {"slices", "1"},   {"resolution", "full"},
                           {"guard_band", "0.09"}, {"blur_size", "5"}};
  };
  for (const Object& object : objects()) {
    const std::vector<Errors> errors =
        errorsOf(object, {setting("assumed", "0.7", "16"), setting("bodies", "1", "24"),
                          setting("drawn", "1", "48")});
    EXPECT_LE(errors[1].rmse, errors[0].rmse + 0.002) << object.name;
    EXPECT_LE(errors[2].rmse, errors[1].rmse) << object.name;
    EXPECT_LT(errors[1].rmse, object.bodies) << object.name;
    EXPECT_LT(errors[2].rmse, object.drawn) << object.name;
    EXPECT_LT(std::abs(errors[2].mean), 0.6 * object.drawn) << object.name;
  }
}

}  // namespace
}  // namespace grisaille::frame
