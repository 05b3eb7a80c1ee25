// SPDX-License-Identifier: MIT
#include <algorithm>

#include "shaders/derivative_frag.h"
#include "shaders/fragcoord_frag.h"
#include "tests/backends/scene.h"

namespace grisaille::tests {
namespace {

using gpu::Cull;
using gpu::Format;

class Raster : public RasterTest {
 protected:
  // Draws three vertices; returns the covered texels of an r8 target.
  std::vector<uint8_t> coverage(const std::vector<float>& positions, Cull cull = Cull::kNone) {
    const Format formats[] = {Format::kR8Unorm};
    const gpu::Texture texture = target(Format::kR8Unorm);
    const gpu::BufferRange streams[] = {{.buffer = vertices(positions)}};
    const gpu::Draw draws[] = {{.pipeline = positionPipeline(&grisaille_shader_white_frag, formats),
                                .vertexStreams = streams,
                                .count = static_cast<uint32_t>(positions.size() / 3),
                                .cull = cull}};
    const gpu::ColorTarget colors[] = {{.view = {.texture = texture}}};
    render({.colors = colors, .draws = draws});
    return readTexture<uint8_t>(texture);
  }
};
GRISAILLE_ON_EVERY_DEVICE(Raster);

TEST_P(Raster, YPointsUp) {
  const std::vector<uint8_t> texels = coverage({-1, 0, 0.5f, 1, 0, 0.5f, 0, 1, 0.5f});
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const float clipX = (static_cast<float>(x) + 0.5f) / kSize * 2 - 1;
      const float clipY = 1 - (static_cast<float>(y) + 0.5f) / kSize * 2;
      const float inside = std::min(clipY, 1 - std::abs(clipX) - clipY);
      if (std::abs(inside) < 1e-3f) continue;  // on an edge
      EXPECT_EQ(texels[y * kSize + x], inside > 0 ? 255 : 0) << x << ", " << y;
    }
  }
}

TEST_P(Raster, CounterClockwiseIsFront) {
  const std::vector<float> counterClockwise = {-1, -3, 0.5f, 3, 1, 0.5f, -1, 1, 0.5f};
  const std::vector<float> clockwise = {-1, -3, 0.5f, -1, 1, 0.5f, 3, 1, 0.5f};
  const std::vector<uint8_t> all(kSize * kSize, 255), none(kSize * kSize, 0);
  EXPECT_EQ(coverage(counterClockwise, Cull::kNone), all);
  EXPECT_EQ(coverage(counterClockwise, Cull::kBack), all);
  EXPECT_EQ(coverage(counterClockwise, Cull::kFront), none);
  EXPECT_EQ(coverage(clockwise, Cull::kNone), all);
  EXPECT_EQ(coverage(clockwise, Cull::kBack), none);
  EXPECT_EQ(coverage(clockwise, Cull::kFront), all);
}

TEST_P(Raster, ShadersSeeTheSameFacingAndDerivatives) {
  const Format formats[] = {Format::kRgba32Float};
  const gpu::ColorTarget colors[] = {{.view = {.texture = target(Format::kRgba32Float)}}};
  const auto texel = [&](const gpu::Shader& fragment, const std::vector<float>& positions) {
    const gpu::BufferRange streams[] = {{.buffer = vertices(positions)}};
    const gpu::Draw draws[] = {
        {.pipeline = positionPipeline(&fragment, formats), .vertexStreams = streams, .count = 3}};
    render({.colors = colors, .draws = draws});
    const std::vector<float> texels = readTexture<float>(colors[0].view.texture);
    return std::array{texels[0], texels[1], texels[2], texels[3]};
  };
  const std::vector<float> front = {-1, -3, 0.5f, 3, 1, 0.5f, -1, 1, 0.5f};
  const std::vector<float> back = {-1, -3, 0.5f, -1, 1, 0.5f, 3, 1, 0.5f};
  EXPECT_EQ(texel(grisaille_shader_fragcoord_frag, front), (std::array{0.5f, 0.5f, 0.5f, 1.0f}));
  EXPECT_EQ(texel(grisaille_shader_fragcoord_frag, back), (std::array{0.5f, 0.5f, 0.5f, -1.0f}));
  EXPECT_EQ(texel(grisaille_shader_derivative_frag, front), (std::array{1.0f, 1.0f, 0.0f, 1.0f}));
}

TEST_P(Raster, TheNearPlaneClips) {
  // Depth above 1 is in front of the near plane, below 0 beyond infinity: neither is drawn.
  const std::vector<uint8_t> all(kSize * kSize, 255), none(kSize * kSize, 0);
  const auto at = [&](float depth) { return coverage({-1, -3, depth, 3, 1, depth, -1, 1, depth}); };
  EXPECT_EQ(at(0.999f), all);
  EXPECT_EQ(at(0.001f), all);
  EXPECT_EQ(at(1.001f), none);
  EXPECT_EQ(at(-0.001f), none);
}

// Vulkan requires 4 bits of sub-pixel precision. Depth may be off by at most the snapping distance.
TEST_P(Raster, VerticesSnapToNoMoreThanASixteenthOfAPixel) {
  const Snapping& found = snapping();
  std::printf("%s: %d bits, depth from up to %.4f pixels away\n", GetParam().label.c_str(),
              found.bits, found.depthShift);
  EXPECT_GE(found.bits, 4);
  EXPECT_LE(found.bits, 12);
  EXPECT_LE(found.depthShift, 1.1 * found.halfStep());
}

TEST_P(Raster, IndicesBeginWhereTheDrawSays) {
  const Format formats[] = {Format::kR8Unorm};
  const gpu::GraphicsPipeline pipeline = positionPipeline(&grisaille_shader_white_frag, formats);
  // Four quadrants of two triangles each, by index.
  std::vector<float> corners;
  for (int i = 0; i < 9; ++i) {
    corners.insert(corners.end(),
                   {static_cast<float>(i % 3 - 1), static_cast<float>(1 - i / 3), 0.5f});
  }
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t corner = i / 2 * 3 + i % 2;
    indices.insert(indices.end(),
                   {corner, corner + 3, corner + 1, corner + 1, corner + 3, corner + 4});
  }
  const gpu::BufferRange streams[] = {{.buffer = vertices(corners)}};
  const gpu::Buffer indexBuffer = bufferOf(indices, gpu::BufferUsage::kIndex);
  const gpu::Texture texture = target(Format::kR8Unorm);
  for (uint32_t quadrant = 0; quadrant < 4; ++quadrant) {
    for (const bool byOffset : {false, true}) {
      const gpu::BufferRange range{.buffer = indexBuffer, .offset = byOffset ? quadrant * 24 : 0};
      const gpu::Draw draws[] = {{.pipeline = pipeline,
                                  .vertexStreams = streams,
                                  .indices = range,
                                  .count = 6,
                                  .first = byOffset ? 0 : quadrant * 6}};
      const gpu::ColorTarget colors[] = {{.view = {.texture = texture}}};
      render({.colors = colors, .draws = draws});
      const std::vector<uint8_t> texels = readTexture<uint8_t>(texture);
      for (uint32_t i = 0; i < kSize * kSize; ++i) {
        const uint32_t in = i / kSize / (kSize / 2) * 2 + i % kSize / (kSize / 2);
        ASSERT_EQ(texels[i], in == quadrant ? 255 : 0) << quadrant << " texel " << i;
      }
    }
  }
}

TEST_P(Raster, VerticesBeginWhereTheDrawSays) {
  const Format formats[] = {Format::kR8Unorm};
  const gpu::GraphicsPipeline pipeline = positionPipeline(&grisaille_shader_white_frag, formats);
  // A degenerate triangle, then one that covers the target.
  const gpu::Buffer buffer =
      vertices({0, 0, 0.5f, 0, 0, 0.5f, 0, 0, 0.5f, -1, -3, 0.5f, 3, 1, 0.5f, -1, 1, 0.5f});
  const gpu::Texture texture = target(Format::kR8Unorm);
  const gpu::ColorTarget colors[] = {{.view = {.texture = texture}}};
  for (const bool byOffset : {false, true}) {
    const gpu::BufferRange streams[] = {{.buffer = buffer, .offset = byOffset ? 36u : 0u}};
    const gpu::Draw draws[] = {
        {.pipeline = pipeline, .vertexStreams = streams, .count = 3, .first = byOffset ? 0u : 3u}};
    render({.colors = colors, .draws = draws});
    EXPECT_EQ(readTexture<uint8_t>(texture), std::vector<uint8_t>(kSize * kSize, 255));
  }
}

TEST_P(Raster, StreamsAndOffsetsFeedTheirAttributes) {
  const Format formats[] = {Format::kRgba32Float};
  const uint32_t strides[] = {20, 24};
  const gpu::VertexAttribute attributes[] = {
      {.location = 1, .stream = 1, .format = gpu::AttributeFormat::kFloat4, .offset = 4},
      {.location = 0, .stream = 0, .format = gpu::AttributeFormat::kFloat3, .offset = 8}};
  const gpu::GraphicsPipeline pipeline = makeGraphics({.vertex = &grisaille_shader_colored_vert,
                                                       .fragment = &grisaille_shader_colored_frag,
                                                       .streamStrides = strides,
                                                       .attributes = attributes,
                                                       .colorFormats = formats});
  const gpu::Buffer positions = vertices({9, 9, -1, -3, 0.5f, 9, 9, 3, 1, 0.5f, 9, 9, -1, 1, 0.5f});
  std::vector<float> colors;
  for (int i = 0; i < 3; ++i) colors.insert(colors.end(), {9, 0.125f, 0.25f, 0.5f, 0.75f, 9});
  const gpu::BufferRange streams[] = {{.buffer = positions}, {.buffer = vertices(colors)}};
  const gpu::Texture texture = target(Format::kRgba32Float);
  const gpu::Draw draws[] = {{.pipeline = pipeline, .vertexStreams = streams, .count = 3}};
  const gpu::ColorTarget targets[] = {{.view = {.texture = texture}}};
  render({.colors = targets, .draws = draws});
  const std::vector<float> texels = readTexture<float>(texture);
  for (size_t i = 0; i < texels.size(); i += 4) {
    ASSERT_NEAR(texels[i], 0.125f, 1e-6);
    ASSERT_NEAR(texels[i + 1], 0.25f, 1e-6);
    ASSERT_NEAR(texels[i + 2], 0.5f, 1e-6);
    ASSERT_NEAR(texels[i + 3], 0.75f, 1e-6);
  }
}

}  // namespace
}  // namespace grisaille::tests
