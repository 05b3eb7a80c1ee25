// SPDX-License-Identifier: MIT
#include "kernel.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace grisaille::ssao {
namespace {

// PCG hash (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering"). Integers give the same
// points on every machine.
uint32_t hash(uint32_t value) {
  const uint32_t state = value * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

class Random {
 public:
  Random(uint32_t seed, uint32_t stream) : state_(hash(seed ^ hash(stream))) {}

  uint32_t next() { return state_ = hash(state_); }
  double unit() { return next() / 4294967296.0; }  // [0, 1)

 private:
  uint32_t state_;
};

double fraction(double value) {
  return value - std::floor(value);
}

}  // namespace

std::array<glm::vec4, kMostPoints> makeKernel(Sampling sampling, uint32_t seed) {
  // Points of the R3 sequence (Roberts 2018) from a random start: each seed gives another set, and
  // no set has the clumps and gaps of independent random points.
  constexpr double kPlastic = 1.2207440846057596;  // root of x^4 = x + 1
  Random random(seed, 0);
  // One statement for each number: C++ leaves the order in which a call evaluates its arguments to
  // the compiler.
  glm::dvec3 start(0);
  for (const int axis : {2, 1, 0}) start[axis] = random.unit();
  std::array<glm::vec4, kMostPoints> kernel{};
  for (uint32_t i = 0; i < kMostPoints; ++i) {
    const double u = fraction(start.x + i / kPlastic);
    const double v = fraction(start.y + i / (kPlastic * kPlastic));
    const double w = fraction(start.z + i / (kPlastic * kPlastic * kPlastic));
    const double angle = glm::two_pi<double>() * v;
    // Hemisphere: cosine-weighted directions, as diffuse light arrives. Sphere: uniform ones.
    const double z = sampling == Sampling::kHemisphere ? std::sqrt(1 - u) : 1 - 2 * u;
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    const double length = w;
    kernel[i] = glm::vec4(
        glm::dvec4(r * std::cos(angle) * length, r * std::sin(angle) * length, z * length, 0));
  }
  return kernel;
}

std::vector<glm::vec2> makeNoise(uint32_t seed) {
  constexpr uint32_t kCount = kNoiseSize * kNoiseSize;
  Random random(seed, 1);
  std::vector<glm::vec2> noise;
  for (uint32_t i = 0; i < kCount; ++i) {
    const double angle = glm::two_pi<double>() * i / kCount;
    noise.emplace_back(std::cos(angle), std::sin(angle));
  }
  for (uint32_t i = kCount - 1; i > 0; --i) std::swap(noise[i], noise[random.next() % (i + 1)]);
  return noise;
}

}  // namespace grisaille::ssao
