// SPDX-License-Identifier: MIT
#include "effects/ssao/kernel.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace grisaille::ssao {
namespace {

TEST(Kernel, PointsLieInTheirVolumeForEverySeed) {
  for (const Sampling sampling : {Sampling::kHemisphere, Sampling::kSphere}) {
    for (uint32_t seed = 0; seed < 50; ++seed) {
      for (const glm::vec4& point : makeKernel(sampling, seed)) {
        EXPECT_LE(glm::length(point), 1.0f + 1e-6f);
        if (sampling == Sampling::kHemisphere) {
          EXPECT_GE(point.z, 0.0f);
        }
        EXPECT_EQ(point.w, 0.0f);
      }
    }
  }
}

TEST(Kernel, DirectionsAreBalancedAboutTheNormal) {
  for (const Sampling sampling : {Sampling::kHemisphere, Sampling::kSphere}) {
    glm::dvec3 mean(0);
    for (uint32_t seed = 0; seed < 64; ++seed) {
      for (const glm::vec4& point : makeKernel(sampling, seed)) {
        mean += glm::normalize(glm::dvec3(point) + glm::dvec3(0, 0, 1e-12));
      }
    }
    mean /= 64.0 * kMostPoints;
    EXPECT_NEAR(mean.x, 0, 0.01);
    EXPECT_NEAR(mean.y, 0, 0.01);
    // The mean cosine is 2/3 with cosine-weighted density, 0 over the sphere.
    EXPECT_NEAR(mean.z, sampling == Sampling::kHemisphere ? 2.0 / 3 : 0, 0.01);
  }
}

TEST(Kernel, SeedsDrawDifferentPointsAndOneSeedTheSame) {
  EXPECT_EQ(makeKernel(Sampling::kHemisphere, 3), makeKernel(Sampling::kHemisphere, 3));
  EXPECT_NE(makeKernel(Sampling::kHemisphere, 3), makeKernel(Sampling::kHemisphere, 4));
  EXPECT_NE(makeNoise(3), makeNoise(4));
}

TEST(Kernel, NoiseHoldsEveryRotationOnce) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    std::vector<double> angles;
    for (const glm::vec2& turn : makeNoise(seed)) {
      EXPECT_NEAR(glm::length(turn), 1, 1e-6);
      angles.push_back(std::atan2(turn.y, turn.x));
    }
    std::sort(angles.begin(), angles.end());
    for (size_t i = 1; i < angles.size(); ++i) {
      EXPECT_NEAR(angles[i] - angles[i - 1], 2 * 3.14159265358979 / 16, 1e-5);
    }
  }
}

}  // namespace
}  // namespace grisaille::ssao
