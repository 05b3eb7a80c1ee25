// SPDX-License-Identifier: MIT
// Slices against the exact visibility of a floor under a box, a sphere, a sheet and a lattice: what
// a segment of matter is when its front and its back are known, see docs/design/ssao.md.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "tests/effects/ssao/render_ao.h"
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
  // and
  // 48. A third above what was measured.
  double bodies = 0, drawn = 0;
};

// One primitive of its own. Corners are shared, as in files.
void addMesh(scene::Scene& scene, const std::vector<glm::vec3>& positions,
             const std::vector<glm::vec3>& normals, const std::vector<uint32_t>& corners,
             uint32_t material = 0) {
  const auto first = static_cast<uint32_t>(scene.positions.size());
  scene.positions.insert(scene.positions.end(), positions.begin(), positions.end());
  scene.normals.insert(scene.normals.end(), normals.begin(), normals.end());
  scene.texCoords.resize(scene.positions.size());
  scene.primitives.push_back({.firstIndex = static_cast<uint32_t>(scene.indices.size()),
                              .indexCount = static_cast<uint32_t>(corners.size()),
                              .material = material});
  for (const uint32_t corner : corners) scene.indices.push_back(first + corner);
  scene.instances.push_back({.primitive = static_cast<uint32_t>(scene.primitives.size() - 1),
                             .worldFromObject = glm::dmat4(1)});
  scene::computeBounds(scene);
}

void addAabb(scene::Scene& scene, const Aabb& box) {
  std::vector<glm::vec3> positions, normals;
  std::vector<uint32_t> corners;
  const glm::dvec3 centre = (box.least + box.most) / 2.0, half = (box.most - box.least) / 2.0;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    glm::dvec3 normal(0), u(0), v(0);
    normal[axis] = side % 2 == 0 ? -1 : 1;
    u[(axis + 1) % 3] = 1;
    v[(axis + 2) % 3] = normal[axis];
    const auto first = static_cast<uint32_t>(positions.size());
    for (const glm::dvec3& corner : {-u - v, u - v, u + v, -u + v}) {
      positions.emplace_back(centre + half * (normal + corner));
      normals.emplace_back(normal);
    }
    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) corners.push_back(first + k);
  }
  addMesh(scene, positions, normals, corners);
}

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
  for (const Aabb& one : all) addAabb(object.scene, one);
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
  std::vector<glm::vec3> positions, normals;
  std::vector<uint32_t> corners;
  for (uint32_t ring = 0; ring <= kRings; ++ring) {
    for (uint32_t step = 0; step <= kAround; ++step) {
      const double down = std::numbers::pi * ring / kRings;
      const double turn = 2 * std::numbers::pi * (step % kAround) / kAround;
      const glm::dvec3 out(std::sin(down) * std::sin(turn), std::cos(down),
                           std::sin(down) * std::cos(turn));
      positions.emplace_back(kCentre + kSize * out);
      normals.emplace_back(out);
      if (ring == kRings || step == kAround) continue;
      const uint32_t a = ring * (kAround + 1) + step, b = a + kAround + 1;
      for (const uint32_t k : {a, b, b + 1, a, b + 1, a + 1}) corners.push_back(k);
    }
  }
  addMesh(object.scene, positions, normals, corners);
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
  addMesh(object.scene, {{-s, h, s}, {s, h, s}, {s, h, -s}, {-s, h, -s}},
          std::vector<glm::vec3>(4, glm::vec3(0, 1, 0)), {0, 1, 2, 0, 2, 3}, 1);
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

double exactVisibility(const Object& object, const glm::dvec3& point) {
  constexpr int kRays = 2000;
  int open = 0;
  for (int i = 0; i < kRays; ++i) {
    const double u = (i + 0.5) / kRays, turn = i * 2.399963229728653;  // a spiral
    const glm::dvec3 unit(std::sqrt(u) * std::cos(turn), std::sqrt(1 - u),
                          std::sqrt(u) * std::sin(turn));
    open += object.hit(point, unit) ? 0 : 1;
  }
  return static_cast<double>(open) / kRays;
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
    const glm::dmat3 axes = scene::worldFromView(camera);
    const double slope = std::tan(glm::radians(camera.fovyDegrees) / 2) * 2 / kTall;
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
        const glm::dvec3 ray((x + 0.5 - kWide / 2.0) * slope, (kTall / 2.0 - y - 0.5) * slope, -1);
        const glm::dvec3 point = camera.eye + axes * ray * double{depth.at(x, y)};
        if (depth.at(x, y) == 0 || std::abs(point.y) > 1e-3) continue;
        if (std::max(std::abs(point.x), std::abs(point.z)) > 0.8) continue;
        const double right = exactVisibility(object, {point.x, 0, point.z});
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
