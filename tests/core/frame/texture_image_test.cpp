// SPDX-License-Identifier: MIT
#include "core/frame/texture_image.h"

#include <gtest/gtest.h>

#include "core/frame/draw_data.h"

namespace grisaille {
namespace {

TEST(TextureImage, NumbersOfEveryKindOfFormat) {
  const std::vector<uint8_t> bytes = {0, 51, 255, 255};
  const auto as = [](const auto& v) { return std::as_bytes(std::span(v)); };
  EXPECT_FLOAT_EQ(frame::toImage(as(bytes), gpu::Format::kR8Unorm, 2, 2).at(1, 0), 0.2f);
  EXPECT_FLOAT_EQ(frame::toImage(as(bytes), gpu::Format::kRgba8Unorm, 1, 1).at(0, 0, 1), 0.2f);
  const image::Image srgb = frame::toImage(as(bytes), gpu::Format::kRgba8Srgb, 1, 1);
  EXPECT_NEAR(srgb.at(0, 0, 1), 0.0331f, 1e-4);
  EXPECT_FLOAT_EQ(srgb.at(0, 0, 3), 1);
  const std::vector<uint16_t> halves = {0x3c00, 0xc000, 0x3800, 0};
  EXPECT_FLOAT_EQ(frame::toImage(as(halves), gpu::Format::kR16Float, 4, 1).at(1, 0), -2);
  EXPECT_FLOAT_EQ(frame::toImage(as(halves), gpu::Format::kRgba16Float, 1, 1).at(0, 0, 2), 0.5f);
  const std::vector<float> floats = {1e6f, -3};
  EXPECT_FLOAT_EQ(frame::toImage(as(floats), gpu::Format::kRg32Float, 1, 1).at(0, 0, 1), -3);
  const std::vector<uint32_t> words = {7};
  EXPECT_FLOAT_EQ(frame::toImage(as(words), gpu::Format::kR32Uint, 1, 1).at(0, 0), 7);
}

TEST(DrawData, MipsEndAtOneTexelAndKeepTheLightOfAConstant) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {5u, 3u}, {64u, 2u}}) {
    const image::Image8 image = {
        .width = width, .height = height, .pixels = std::vector<uint8_t>(width * height * 4, 137)};
    const auto levels = frame::mipChain(image);
    EXPECT_EQ(levels.back().size(), 4u);
    for (const auto& level : levels) {
      for (const uint8_t value : level) EXPECT_EQ(value, 137);
    }
  }
}

TEST(DrawData, MipsAverageLightNotCodes) {
  const image::Image8 image = {.width = 2, .height = 1, .pixels = {0, 0, 0, 0, 255, 255, 255, 255}};
  const auto levels = frame::mipChain(image);
  EXPECT_EQ(levels[1][0], 188);  // half the light, in sRGB
  EXPECT_EQ(levels[1][3], 128);  // alpha is linear
}

TEST(DrawData, NormalsStayPerpendicularUnderAnyLinearMap) {
  for (int i = 0; i < 200; ++i) {
    glm::dmat3 m;
    for (int c = 0; c < 9; ++c) m[c / 3][c % 3] = std::sin(i * 12.9898 + c * 78.233) * 3;
    if (std::abs(glm::determinant(m)) < 1e-3) continue;
    const glm::dvec3 a(0.3, -1, 0.2), b(1, 0.5, -2);
    const glm::dvec3 n = glm::dmat3(frame::normalTransform(m)) * glm::cross(a, b);
    EXPECT_NEAR(glm::dot(n, m * a) / (glm::length(n) * glm::length(m * a)), 0, 1e-9);
    EXPECT_NEAR(glm::dot(n, m * b) / (glm::length(n) * glm::length(m * b)), 0, 1e-9);
    // The outer side stays outside.
    EXPECT_GT(glm::dot(n, m * glm::cross(a, b)), 0);
  }
}

}  // namespace
}  // namespace grisaille
