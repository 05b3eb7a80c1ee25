// SPDX-License-Identifier: MIT
// The result of a ray does not depend on the other rays of its batch, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "core/trace/ray_tracer.h"
#include "tests/core/trace/scene_builder.h"

namespace grisaille::trace {
namespace {

class Dice {
 public:
  explicit Dice(uint32_t seed) : random_(seed) {}
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  size_t below(size_t end) { return std::uniform_int_distribution<size_t>(0, end - 1)(random_); }
  glm::dvec3 direction() {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random_), normal(random_), normal(random_)));
  }
  glm::dvec3 point() { return {unit(), unit(), unit()}; }  // in the unit cube
  std::mt19937& engine() { return random_; }

 private:
  std::mt19937 random_;
};

glm::dvec3 cornerOf(const scene::Scene& scene, Dice& dice) {
  const scene::Instance& instance = scene.instances[dice.below(scene.instances.size())];
  const scene::Primitive& primitive = scene.primitives[instance.primitive];
  const uint32_t vertex = scene.indices[primitive.firstIndex + dice.below(primitive.indexCount)];
  return glm::dvec3(instance.worldFromObject * glm::dvec4(glm::dvec3(scene.positions[vertex]), 1));
}

// Rays from one muzzle, in a cone of any width from a needle to all directions. Many aim at corners
// of triangles, where they hit several at once; some of these run along an axis and are free of
// rounding.
void addVolley(const scene::Scene& scene, Dice& dice, std::vector<grisaille_ray>& rays) {
  const glm::dvec3 target = dice.below(2) == 0
                                ? cornerOf(scene, dice)
                                : glm::mix(scene.bounds.min, scene.bounds.max, dice.point());
  glm::dvec3 forward(0);
  if (dice.below(2) == 0) {
    forward[static_cast<int>(dice.below(3))] = dice.below(2) == 0 ? -1 : 1;
  } else {
    forward = dice.direction();
  }
  const double size = glm::length(scene.bounds.max - scene.bounds.min);
  const double away = size * std::exp2((dice.below(4) == 0 ? 20 : -8) * dice.unit());
  const glm::dvec3 muzzle = target - away * forward;
  const double width = std::exp2(-12 * dice.unit());
  const bool limited = dice.below(3) == 0;
  const size_t count = 1 + dice.below(160);
  for (size_t i = 0; i < count; ++i) {
    glm::dvec3 direction = forward + (i == 0 ? 0 : width) * dice.direction();
    if (i > 0 && dice.below(4) == 0) direction = cornerOf(scene, dice) - muzzle;
    const glm::vec3 d(glm::normalize(direction));
    const float reach = limited ? static_cast<float>(2 * away * dice.unit() + 1e-3) : INFINITY;
    rays.push_back({{muzzle.x, muzzle.y, muzzle.z}, {d.x, d.y, d.z}, reach});
  }
}

std::vector<grisaille_hit> cast(const RayTracer& tracer, std::span<const grisaille_ray> rays) {
  std::vector<grisaille_hit> hits(rays.size());
  tracer.castRays(rays, hits);
  return hits;
}

bool sameBits(const grisaille_hit& a, const grisaille_hit& b) {
  using Bits = std::array<uint32_t, sizeof(grisaille_hit) / 4>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

// Casts the rays all at once, in batches of random sizes, shuffled, and one at a time.
void expectSameInAnyBatch(const scene::Scene& scene, uint32_t seed, size_t volleys) {
  const RayTracer tracer(scene, (scene.bounds.min + scene.bounds.max) / 2.0);
  Dice dice(seed);
  std::vector<grisaille_ray> rays;
  for (size_t i = 0; i < volleys; ++i) addVolley(scene, dice, rays);
  const std::vector<grisaille_hit> all = cast(tracer, rays);
  size_t surfaces = 0;
  for (size_t first = 0; first < rays.size();) {
    const size_t count = std::min(1 + dice.below(300), rays.size() - first);
    const auto part = cast(tracer, std::span(rays).subspan(first, count));
    for (size_t i = 0; i < count; ++i) {
      ASSERT_TRUE(sameBits(part[i], all[first + i])) << "ray " << first + i << " of " << count;
    }
    first += count;
  }
  std::vector<size_t> order(rays.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::shuffle(order, dice.engine());
  std::vector<grisaille_ray> shuffled;
  for (const size_t i : order) shuffled.push_back(rays[i]);
  const auto mixed = cast(tracer, shuffled);
  for (size_t i = 0; i < order.size(); ++i) {
    ASSERT_TRUE(sameBits(mixed[i], all[order[i]])) << "ray " << order[i] << " shuffled";
    const auto alone = cast(tracer, std::span(rays).subspan(order[i], 1));
    ASSERT_TRUE(sameBits(alone[0], all[order[i]])) << "ray " << order[i] << " alone";
    surfaces += alone[0].kind == GRISAILLE_HIT_SURFACE ? 1 : 0;
  }
  EXPECT_GT(surfaces, rays.size() / 5);
  EXPECT_LT(surfaces, rays.size());
}

TEST(CastBatches, ChangeNothingInTheAtrium) {
  expectSameInAnyBatch(scene::makeAtrium(), 1, 300);
}

// Cards with holes; roofs with sides that meet at a ridge, which rays hit exactly; stacks of cards
// that coincide in 32 bits but differ in the reported distances.
TEST(CastBatches, ChangeNothingAmongHolesRidgesAndTwins) {
  const scene::Scene atrium = scene::makeAtrium();
  const auto leaves = std::ranges::find_if(atrium.materials, [](const scene::Material& m) {
    return m.masked && m.baseColorTexture >= 0;
  });
  ASSERT_NE(leaves, atrium.materials.end());
  SceneBuilder builder;
  builder.scene.textures = atrium.textures;
  const std::array materials = {builder.material(*leaves), builder.material({}),
                                builder.material({.name = "both", .doubleSided = true})};
  Dice dice(4);
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 middle = 8.0 * dice.direction();
    const glm::vec3 ridge(dice.unit() * dice.direction());
    for (int side = 0; side < 3; ++side) {
      const glm::vec3 down(dice.unit() * dice.direction());
      builder.place(builder.quad({-ridge, ridge, ridge + down, down - ridge},
                                 materials[dice.below(materials.size())]),
                    glm::translate(glm::dmat4(1), middle));
    }
  }
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 middle = 8.0 * dice.direction();
    const glm::vec3 a(dice.direction()), b(dice.direction());
    const uint32_t card = builder.quad({-a - b, a - b, a + b, b - a}, materials[1]);
    for (int twin = 0; twin < 12; ++twin) {
      builder.place(card, glm::translate(glm::dmat4(1), middle + 1e-7 * dice.direction()));
    }
  }
  scene::computeBounds(builder.scene);
  expectSameInAnyBatch(builder.scene, 5, 300);
}

}  // namespace
}  // namespace grisaille::trace
