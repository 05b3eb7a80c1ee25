// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "core/image/image.h"
#include "core/scene/scene.h"

namespace grisaille::scene {
namespace {

TEST(Sponza, LoadsWholeAndFast) {
  const char* given = std::getenv("GRISAILLE_SPONZA");
  const std::string path = given ? given : SPONZA_DEFAULT;
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << path << " is missing; set GRISAILLE_SPONZA to test with Sponza";
  }
  const auto start = std::chrono::steady_clock::now();
  const Scene scene = loadGltf(path);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  EXPECT_EQ(triangleCount(scene), 262267u);
  EXPECT_EQ(scene.primitives.size(), 103u);
  EXPECT_EQ(scene.materials.size(), 25u);
  const glm::dvec3 low(-15.4, -1.0, -9.5), high(14.4, 11.4, 8.8);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(scene.bounds.min[i], low[i], 0.06);
    EXPECT_NEAR(scene.bounds.max[i], high[i], 0.06);
  }
  for (const glm::vec3& normal : scene.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-5);
  for (const Texture& texture : scene.textures) {
    const image::Image8 picture = texelsOf(texture);
    EXPECT_GT(picture.width, 0u);
  }
  bool masked = false;
  for (const Material& material : scene.materials) masked = masked || material.masked;
  EXPECT_TRUE(masked);
}

}  // namespace
}  // namespace grisaille::scene
