// SPDX-License-Identifier: MIT
// Which triangles belong to closed bodies.
#include "core/scene/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/scenes.h"

namespace grisaille {
namespace {

constexpr size_t kBoxTriangles = 12;

scene::Scene boxScene(bool doubleSided = false) {
  scene::Scene scene;
  scene.materials.push_back({.name = "box", .doubleSided = doubleSided});
  tests::addBox(scene, glm::dmat4(1));
  return scene;
}

auto bodiesOf(const scene::Scene& scene) {
  return std::ranges::count(scene::matterOf(scene).bodies, true);
}

glm::dmat4 movedTo(double x) {
  glm::dmat4 place(1);
  place[3].x = x;
  return place;
}

// Turns the triangles of a primitive around.
void turn(scene::Scene& scene, size_t primitive) {
  const scene::Primitive& turned = scene.primitives[primitive];
  for (uint32_t i = 0; i < turned.indexCount; i += 3) {
    std::swap(scene.indices[turned.firstIndex + i], scene.indices[turned.firstIndex + i + 1]);
  }
}

TEST(Bodies, AClosedBoxIsOneWhateverItsMaterialSays) {
  EXPECT_EQ(bodiesOf(boxScene(false)), 12);
  EXPECT_EQ(bodiesOf(boxScene(true)), 12);
}

TEST(Bodies, NegativeZeroIsZero) {
  scene::Scene scene = boxScene();
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    glm::vec3& p = scene.positions[i];
    if (p.x == 1) p.x = i % 2 == 0 ? 0.0f : -0.0f;
  }
  EXPECT_EQ(bodiesOf(scene), 12);
}

TEST(Bodies, ABoxTurnedInsideOutIsStillClosed) {
  scene::Scene scene = boxScene();
  for (size_t i = 0; i < scene.primitives.size(); ++i) turn(scene, i);
  EXPECT_EQ(bodiesOf(scene), 12);
}

TEST(Bodies, ABoxWithoutALidIsOne) {
  scene::Scene scene = boxScene();
  scene.instances.pop_back();
  EXPECT_EQ(bodiesOf(scene), 10);
}

TEST(Bodies, TwoSidesOfABoxAreNone) {
  scene::Scene scene = boxScene();
  scene.instances = {scene.instances[0], scene.instances[2]};
  EXPECT_EQ(bodiesOf(scene), 0);
}

TEST(Bodies, ABoxWithSidesTurnedIsNone) {
  scene::Scene scene = boxScene();
  for (const size_t side : {1u, 3u, 5u}) turn(scene, side);
  EXPECT_EQ(bodiesOf(scene), 0);
}

TEST(Bodies, AMaskedSideIsAHole) {
  scene::Scene scene = boxScene();
  scene.materials.push_back({.name = "grille", .masked = true});
  scene.primitives[3].material = 1;
  const std::vector<bool> bodies = scene::matterOf(scene).bodies;
  EXPECT_EQ(std::ranges::count(bodies, true), 10);
  EXPECT_FALSE(bodies[6] || bodies[7]);
}

// A banner of steep waves: a sheet, though much of it sees its own back.
TEST(Bodies, AFoldedSheetIsNone) {
  scene::Scene scene;
  scene.materials.push_back({.name = "banner", .doubleSided = true});
  for (int i = 0; i < 64; ++i) {
    const auto at = [](int k) {
      const auto x = static_cast<float>(k) / 8;
      return glm::vec2(x, 0.3f * std::sin(x * 6.2831853f));
    };
    const glm::vec2 from = at(i), to = at(i + 1);
    tests::addQuad(
        scene,
        {glm::vec3(from.x, 0, from.y), {to.x, 0, to.y}, {to.x, 3, to.y}, {from.x, 3, from.y}},
        {0, 0, 1});
  }
  EXPECT_EQ(bodiesOf(scene), 0);
}

// Bodies of any size, far from the origin, with a crack that welding does not close.
TEST(Bodies, ACrackedBoxIsOneAtEverySize) {
  for (const float size : {1e-9f, 1e-3f, 1.0f, 1e6f}) {
    scene::Scene scene = boxScene(true);
    for (size_t i = 0; i < 4; ++i) scene.positions[i].x += 1e-3f;
    for (glm::vec3& p : scene.positions) p = size * (p + glm::vec3(30, 0, 5));
    const std::vector<bool> bodies = scene::matterOf(scene).bodies;
    // The side beyond the crack is a part of its own.
    EXPECT_EQ(std::ranges::count(bodies, true), 10) << size;
  }
}

TEST(Bodies, ASideWithAnotherTransformIsAnotherObject) {
  scene::Scene scene = boxScene();
  scene.instances[4].worldFromObject = movedTo(1e-9);
  const std::vector<bool> bodies = scene::matterOf(scene).bodies;
  EXPECT_EQ(std::ranges::count(bodies, true), 10);
  EXPECT_FALSE(bodies[8] || bodies[9]);
}

TEST(Bodies, PartsAreJudgedOneByOne) {
  scene::Scene scene = boxScene(true);
  // A sheet that touches the box in one corner, and one beside it.
  tests::addQuad(scene, {glm::vec3(1, 1, 1), {2, 1, 1}, {2, 2, 1}, {1, 2, 1}}, {0, 0, 1});
  tests::addQuad(scene, {glm::vec3(3, 0, 0), {4, 0, 0}, {4, 1, 0}, {3, 1, 0}}, {0, 0, 1});
  const std::vector<bool> bodies = scene::matterOf(scene).bodies;
  ASSERT_EQ(bodies.size(), kBoxTriangles + 4);
  EXPECT_EQ(std::ranges::count(bodies, true), 12);
  EXPECT_EQ(std::count(bodies.begin() + kBoxTriangles, bodies.end(), true), 0);
}

TEST(Bodies, BoxesThatShareAnEdgeAreClosed) {
  scene::Scene scene = boxScene();
  tests::addBox(scene, glm::dmat4(1));
  for (size_t i = scene.positions.size() / 2; i < scene.positions.size(); ++i) {
    scene.positions[i] += glm::vec3(2, 2, 0);
  }
  EXPECT_EQ(bodiesOf(scene), 24);
}

TEST(Bodies, TrianglesWithoutAnAreaBelongToNone) {
  scene::Scene scene = boxScene();
  scene.primitives.push_back(
      {.firstIndex = static_cast<uint32_t>(scene.indices.size()), .indexCount = 3});
  scene.instances.push_back({.primitive = 6});
  scene.indices.insert(scene.indices.end(), {0, 0, 1});
  const std::vector<bool> bodies = scene::matterOf(scene).bodies;
  EXPECT_EQ(std::ranges::count(bodies, true), 12);
  EXPECT_FALSE(bodies.back());
}

TEST(Bodies, EachInstanceMustBeClosed) {
  scene::Scene scene = boxScene();
  // The same six sides twice more, then one side alone.
  for (const double x : {3.0, 6.0}) {
    for (uint32_t i = 0; i < 6; ++i) {
      scene.instances.push_back({.primitive = i, .worldFromObject = movedTo(x)});
    }
  }
  EXPECT_EQ(bodiesOf(scene), 12);
  scene.instances.push_back({.primitive = 1, .worldFromObject = movedTo(9)});
  const std::vector<bool> bodies = scene::matterOf(scene).bodies;
  EXPECT_EQ(std::ranges::count(bodies, true), 10);
  EXPECT_FALSE(bodies[2] || bodies[3]);
}

// A box of a x b x c has the mean chord 4 a b c / (2 (a b + b c + c a)).
TEST(Bodies, AreAsThickAsTheirMeanChord) {
  scene::Scene scene = boxScene();
  for (const float t : scene::matterOf(scene).thickness) EXPECT_NEAR(t, 4.0 / 3, 1e-6);
  for (const scene::Primitive& primitive : scene.primitives) {
    for (uint32_t i = 0; i < primitive.indexCount; i += 3) {
      std::swap(scene.indices[primitive.firstIndex + i],
                scene.indices[primitive.firstIndex + i + 1]);
    }
  }
  for (const float t : scene::matterOf(scene).thickness) EXPECT_NEAR(t, 4.0 / 3, 1e-6);
  // Far from its own origin.
  for (glm::vec3& p : scene.positions) p = glm::vec3(100) + p * glm::vec3(1, 0.01f, 1);
  const double plate = 4 * (2 * 2 * 0.02) / (2 * (2 * 2 + 2 * 2 * 0.02));
  for (const float t : scene::matterOf(scene).thickness) EXPECT_NEAR(t, plate, 1e-3);
  // Without a lid: of the cones from its surface to its centroid.
  scene::Scene open = boxScene();
  open.instances.pop_back();
  const scene::Matter matter = scene::matterOf(open);
  for (size_t i = 0; i < 10; ++i) EXPECT_NEAR(matter.thickness[i], 4.0 / 3, 0.3);
  EXPECT_EQ(matter.thickness[10], -1);  // without an instance
}

TEST(Bodies, AStretchedBoxHasTheMeanChordOfItsNewSides) {
  scene::Scene scene = boxScene();
  const glm::dvec3 sides(0.1, 2, 30);  // of a box with sides of 2
  for (const glm::dvec3& areas : scene::matterOf(scene).areas) {
    const glm::dmat3 stretch(glm::scale(glm::dmat4(1), sides));
    const double surface = sides.x * sides.y + sides.y * sides.z + sides.z * sides.x;
    const double chord = 4 * sides.x * sides.y * sides.z / surface;
    EXPECT_NEAR(scene::chordScale(areas, stretch) * 4 / 3, chord, 1e-9);
    EXPECT_NEAR(scene::chordScale(areas, -3.0 * glm::dmat3(1)), 3, 1e-9);
    EXPECT_EQ(scene::chordScale(areas, glm::dmat3(0)), 0);
  }
}

TEST(Bodies, SheetsHaveNoThicknessAndOtherSurfacesAnUnknownOne) {
  scene::Scene scene;
  scene.materials.push_back({.name = "wall"});
  scene.materials.push_back({.name = "banner", .doubleSided = true});
  scene.materials.push_back({.name = "leaf", .masked = true});
  for (uint32_t m = 0; m < 3; ++m) {
    const float z = static_cast<float>(m);
    tests::addQuad(scene, {glm::vec3(0, 0, z), {1, 0, z}, {1, 1, z}, {0, 1, z}}, {0, 0, 1}, m);
  }
  const scene::Matter matter = scene::matterOf(scene);
  EXPECT_EQ(matter.thickness, (std::vector<float>{-1, -1, 0, 0, 0, 0}));
  const std::vector<float> vertices = scene::vertexThickness(scene, matter);
  EXPECT_EQ(vertices, (std::vector<float>{-1, -1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Bodies, PrimitivesWithoutAnInstanceAndEmptyScenesHaveNone) {
  scene::Scene scene = boxScene();
  scene.instances.clear();
  EXPECT_EQ(bodiesOf(scene), 0);
  EXPECT_TRUE(scene::matterOf(scene::Scene()).bodies.empty());
}

}  // namespace
}  // namespace grisaille
