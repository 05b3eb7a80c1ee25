// SPDX-License-Identifier: MIT
#include "core/scene/mesh_builder.h"

#include <array>
#include <cmath>

#include "tests/core/scene/mesh_checks.h"

namespace grisaille::scene {
namespace {

constexpr double kPi = 3.14159265358979323846;

Scene sceneOf(const Solid& solid, double crease = 0.8) {
  Scene scene;
  addPrimitive(scene, solid, 0, crease);
  return scene;
}

void expectSolid(const Solid& solid, double expected, double tolerance) {
  const Scene scene = sceneOf(solid);
  EXPECT_EQ(openEdges(scene, scene.primitives[0]), 0u);
  EXPECT_NEAR(volume(scene, scene.primitives[0]), expected, tolerance);
}

TEST(MeshBuilder, SinesAreSines) {
  for (int i = -2000; i < 2000; ++i) {
    const double turns = i * 0.00137;
    EXPECT_NEAR(sinTurns(turns), std::sin(2 * kPi * turns), 1e-14);
    EXPECT_NEAR(cosTurns(turns), std::cos(2 * kPi * turns), 1e-14);
  }
}

TEST(MeshBuilder, HashesSpreadOverTheUnitRange) {
  double sum = 0;
  for (uint32_t i = 0; i < 10000; ++i) {
    const double value = hashUnit(i);
    ASSERT_TRUE(value >= 0 && value < 1);
    sum += value;
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.01);
}

TEST(MeshBuilder, SolidsAreClosedAndTurnedOut) {
  expectSolid(box({-1, 0, 2}, {1, 3, 5}), 18, 1e-5);
  expectSolid(box({0, 0, 0}, {1, 1, 1}, 0.1), 1 - 0.1 * (1 - 0.81 - 0.1 * 0.2 / 3 * 2), 5e-3);
  expectSolid(lathe(std::array{glm::dvec2(1, 0), glm::dvec2(1, 2)}, 256), 2 * kPi, 1e-2);
  expectSolid(lathe(std::array{glm::dvec2(1, 2), glm::dvec2(1, 0)}, 256), 2 * kPi, 1e-2);
  expectSolid(
      frame(std::array{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)},
            {3, 2}),
      24 - 8, 1e-4);
  const auto level = [](double y) { return [y](double, double) { return y; }; };
  expectSolid(slab({0, 0}, {2, 3}, 5, level(1), level(2)), 6, 1e-4);
  expectSolid(slab({0, 0}, {2, 3}, 6, level(2), level(1)), 6, 1e-4);
  const Solid fluted = lathe(std::array{glm::dvec2(1, 0), glm::dvec2(0.9, 2)}, 48, 12, 0.1);
  expectSolid(fluted, 2 * kPi * 0.8, 0.4);
  Solid two = box({0, 0, 0}, {1, 1, 1});
  append(two, box({0, 0, 0}, {1, 1, 1}), moved({5, 0, 0}) * turned(0.125));
  expectSolid(two, 2, 1e-5);
}

TEST(MeshBuilder, CreasesAreSharpAndTheRestIsSmooth) {
  const Scene cube = sceneOf(box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(cube.positions.size(), 24u);  // three normals per corner
  const Scene can = sceneOf(lathe(std::array{glm::dvec2(1, 0), glm::dvec2(1, 2)}, 32));
  for (size_t i = 0; i < can.positions.size(); ++i) {
    const glm::vec3 p = can.positions[i], n = can.normals[i];
    const glm::vec3 side = glm::normalize(glm::vec3(p.x, 0, p.z));
    const bool onSide = glm::dot(n, side) > 0.999f, onCap = std::abs(n.y) > 0.999f;
    EXPECT_TRUE(onSide || onCap) << i;
  }
}

TEST(MeshBuilder, SheetsCarryTexCoords) {
  const Scene scene = sceneOf(sheet(3, 2, [](double u, double v) { return glm::dvec3(u, -v, 0); }));
  EXPECT_EQ(scene.indices.size(), 3u * 2 * 6);
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    EXPECT_EQ(scene.texCoords[i], glm::vec2(scene.positions[i].x, -scene.positions[i].y));
    EXPECT_EQ(scene.normals[i], glm::vec3(0, 0, 1));
  }
}

}  // namespace
}  // namespace grisaille::scene
