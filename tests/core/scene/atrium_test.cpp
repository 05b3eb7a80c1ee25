// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "tests/core/scene/mesh_checks.h"

namespace grisaille::scene {
namespace {

const Scene& atrium() {
  static const Scene scene = makeAtrium();
  return scene;
}

// FNV-1a over 64 bits.
uint64_t hash(uint64_t state, const void* bytes, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    state = (state ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3u;
  }
  return state;
}

template <typename T>
uint64_t hash(uint64_t state, const std::vector<T>& values) {
  return hash(state, values.data(), values.size() * sizeof(T));
}

TEST(Atrium, HasItsSize) {
  EXPECT_GE(triangleCount(atrium()), 50000u);
  EXPECT_LE(triangleCount(atrium()), 120000u);
  const glm::dvec3 size = atrium().bounds.max - atrium().bounds.min;
  EXPECT_NEAR(size.x, 20, 1.5);
  EXPECT_NEAR(size.y, 8, 1.5);
  EXPECT_NEAR(size.z, 12, 1.5);
}

TEST(Atrium, IsTheSameOnEveryMachine) {
  uint64_t state = 0xcbf29ce484222325u;
  state = hash(state, atrium().positions);
  state = hash(state, atrium().normals);
  state = hash(state, atrium().texCoords);
  state = hash(state, atrium().indices);
  for (const Instance& instance : atrium().instances) {
    state = hash(state, &instance.worldFromObject, sizeof instance.worldFromObject);
  }
  EXPECT_EQ(state, 16779352904752206454u);
  const image::Image8 leaf = texelsOf(atrium().textures.at(0));
  EXPECT_EQ(hash(0xcbf29ce484222325u, leaf.pixels), 2333328223688851514u);
}

TEST(Atrium, ArraysFitTogether) {
  const Scene& scene = atrium();
  EXPECT_EQ(scene.normals.size(), scene.positions.size());
  EXPECT_EQ(scene.texCoords.size(), scene.positions.size());
  for (const uint32_t index : scene.indices) ASSERT_LT(index, scene.positions.size());
  std::vector<bool> shown(scene.primitives.size(), false);
  for (const Instance& instance : scene.instances) shown.at(instance.primitive) = true;
  EXPECT_TRUE(std::ranges::all_of(shown, [](bool b) { return b; }));
  for (const Primitive& primitive : scene.primitives) {
    EXPECT_LT(primitive.material, scene.materials.size());
    EXPECT_EQ(primitive.indexCount % 3, 0u);
  }
  for (const Instance& instance : scene.instances) {
    EXPECT_NEAR(glm::determinant(instance.worldFromObject), 1, 1e-9);
  }
}

TEST(Atrium, SolidsAreClosedAndTurnedOut) {
  for (size_t i = 0; i < atrium().primitives.size(); ++i) {
    const Primitive& primitive = atrium().primitives[i];
    if (atrium().materials[primitive.material].doubleSided) continue;
    EXPECT_EQ(openEdges(atrium(), primitive), 0u) << i;
    EXPECT_GT(volume(atrium(), primitive), 0) << i;
  }
}

TEST(Atrium, NormalsAreUnitAndAgreeWithTheWinding) {
  const Scene& scene = atrium();
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    const auto p = [&](size_t k) { return glm::dvec3(scene.positions[scene.indices[i + k]]); };
    const glm::dvec3 face = glm::cross(p(1) - p(0), p(2) - p(0));
    ASSERT_GT(glm::length(face), 1e-9) << "triangle without area: " << i / 3;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 normal(scene.normals[scene.indices[i + k]]);
      ASSERT_NEAR(glm::length(normal), 1, 1e-6);
      ASSERT_GT(glm::dot(normal, glm::normalize(face)), 0.2) << i / 3;
    }
  }
}

TEST(Atrium, TheLeafHasHolesAndSubstance) {
  const image::Image8 leaf = texelsOf(atrium().textures.at(0));
  size_t opaque = 0;
  for (size_t i = 3; i < leaf.pixels.size(); i += 4) opaque += leaf.pixels[i] >= 128;
  const double share = static_cast<double>(opaque) / (leaf.width * leaf.height);
  EXPECT_GT(share, 0.15);
  EXPECT_LT(share, 0.7);
}

TEST(Atrium, TheCameraStandsInside) {
  const Camera camera = atriumCamera();
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(camera.eye[i], atrium().bounds.min[i]);
    EXPECT_LT(camera.eye[i], atrium().bounds.max[i]);
  }
}

}  // namespace
}  // namespace grisaille::scene
