// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "shaders/fetch_comp.h"
#include "shaders/textured_frag.h"
#include "shaders/three_targets_frag.h"
#include "tests/backends/scene.h"

namespace grisaille::tests {
namespace {

using gpu::Format;
using gpu::Load;
using gpu::TextureUsage;

class Targets : public RasterTest {
 protected:
  // Draws full triangles at these depths in order, in the colours 1, 2, 3 ... Returns the first
  // texel of the float target.
  float winner(const std::vector<float>& depths) {
    const Format formats[] = {Format::kRgba32Float};
    const gpu::GraphicsPipeline pipeline =
        positionPipeline(&grisaille_shader_uniform_color_frag, formats, Format::kD32Float);
    const gpu::Texture color = target(Format::kRgba32Float), depth = target(Format::kD32Float);
    std::vector<std::vector<gpu::BufferRange>> streams;
    for (const float value : depths) streams.push_back({{.buffer = everything(value)}});
    inFrame([&](gpu::Commands& commands) {
      std::vector<gpu::Binding> paints;
      for (size_t i = 0; i < depths.size(); ++i) {
        const std::array<float, 4> paint = {static_cast<float>(i + 1), 0, 0, 0};
        paints.push_back(gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(paint)))));
      }
      std::vector<gpu::Draw> draws;
      for (size_t i = 0; i < depths.size(); ++i) {
        draws.push_back({.pipeline = pipeline,
                         .bindings = {&paints[i], 1},
                         .vertexStreams = streams[i],
                         .count = 3});
      }
      const gpu::ColorTarget colors[] = {{.view = {.texture = color}}};
      commands.beginPass("depths");
      commands.render({.colors = colors, .depth = {.view = {.texture = depth}}, .draws = draws});
      commands.endPass();
    });
    return readTexture<float>(color)[0];
  }
};
GRISAILLE_ON_EVERY_DEVICE(Targets);

TEST_P(Targets, TheNearerWinsAndTheEqualLoses) {
  EXPECT_EQ(winner({0.25f, 0.75f}), 2.0f);
  EXPECT_EQ(winner({0.75f, 0.25f}), 1.0f);
  EXPECT_EQ(winner({0.5f, 0.5f, 0.5f}), 1.0f);
  EXPECT_EQ(winner({0.1f, 0.3f, 0.2f, 0.9f, 0.8f}), 4.0f);
  EXPECT_EQ(winner({0.0f}), 0.0f);  // infinite distance equals the clear value
}

TEST_P(Targets, DepthAloneNeedsNoFragmentShader) {
  const gpu::GraphicsPipeline pipeline = positionPipeline(nullptr, {}, Format::kD32Float);
  const gpu::Texture depth = target(Format::kD32Float);
  const gpu::BufferRange far[] = {{.buffer = everything(0.125f)}};
  // The left half, nearer.
  const gpu::BufferRange near[] = {{.buffer = vertices({-1, -1, 0.5f, 0, -1, 0.5f, 0, 1, 0.5f,  //
                                                        -1, -1, 0.5f, 0, 1, 0.5f, -1, 1, 0.5f})}};
  const gpu::Draw draws[] = {{.pipeline = pipeline, .vertexStreams = far, .count = 3},
                             {.pipeline = pipeline, .vertexStreams = near, .count = 6}};
  render({.depth = {.view = {.texture = depth}}, .draws = draws});
  const std::vector<float> values = readTexture<float>(depth);
  for (uint32_t i = 0; i < kSize * kSize; ++i) {
    ASSERT_EQ(values[i], i % kSize < kSize / 2 ? 0.5f : 0.125f);
  }
  // The depth can be sampled afterwards.
  const gpu::Buffer out = makeBuffer(kSize * kSize * 4, gpu::BufferUsage::kStorage);
  const gpu::Binding bindings[] = {
      gpu::textureBinding(0, {.texture = depth}, makeSampler({.label = "depth"})),
      gpu::storageBinding(0, {.buffer = out})};
  compute({.pipeline = makeCompute(grisaille_shader_fetch_comp),
           .bindings = bindings,
           .groups = {kSize / 8, kSize / 8, 1}});
  EXPECT_EQ(readBuffer<float>({.buffer = out}), values);
}

TEST_P(Targets, SeveralAreWrittenAtOnce) {
  const Format formats[] = {Format::kRgba8Unorm, Format::kR32Float, Format::kR32Uint};
  const gpu::GraphicsPipeline pipeline =
      positionPipeline(&grisaille_shader_three_targets_frag, formats);
  const gpu::ColorTarget colors[] = {{.view = {.texture = target(formats[0])}},
                                     {.view = {.texture = target(formats[1])}},
                                     {.view = {.texture = target(formats[2])}}};
  const gpu::BufferRange streams[] = {{.buffer = everything()}};
  const gpu::Draw draws[] = {{.pipeline = pipeline, .vertexStreams = streams, .count = 3}};
  render({.colors = colors, .draws = draws});
  const std::vector<uint8_t> first = readTexture<uint8_t>(colors[0].view.texture);
  const std::vector<float> second = readTexture<float>(colors[1].view.texture);
  const std::vector<uint32_t> third = readTexture<uint32_t>(colors[2].view.texture);
  for (uint32_t i = 0; i < kSize * kSize; ++i) {
    ASSERT_NEAR(first[i * 4], 63.75, 0.76);
    ASSERT_NEAR(first[i * 4 + 2], 191.25, 0.76);
    ASSERT_EQ(second[i], static_cast<float>(i % kSize) + 0.5f);
    ASSERT_EQ(third[i], i / kSize);
  }
}

TEST_P(Targets, AreClearedLoadedOrDiscarded) {
  const Format formats[] = {Format::kRgba32Float};
  const gpu::Texture color = target(Format::kRgba32Float), depth = target(Format::kD32Float);
  const gpu::ColorTarget clear[] = {{.view = {.texture = color}, .clear = {0.25f, -2, 3, 0.5f}}};
  render({.colors = clear, .depth = {.view = {.texture = depth}, .clear = 0.5f}});
  EXPECT_EQ(readTexture<float>(depth), std::vector<float>(kSize * kSize, 0.5f));
  const std::vector<float> cleared = readTexture<float>(color);
  for (size_t i = 0; i < cleared.size(); ++i) {
    ASSERT_EQ(cleared[i], clear[0].clear[i % 4]);
  }
  // Loaded depth hides farther draws; loaded colour stays where no draw covers it.
  const gpu::GraphicsPipeline pipeline =
      positionPipeline(&grisaille_shader_white_frag, formats, Format::kD32Float);
  const gpu::BufferRange far[] = {{.buffer = everything(0.4f)}};
  const gpu::Draw hidden[] = {{.pipeline = pipeline, .vertexStreams = far, .count = 3}};
  const gpu::ColorTarget load[] = {{.view = {.texture = color}, .load = Load::kLoad}};
  render({.colors = load,
          .depth = {.view = {.texture = depth}, .load = Load::kLoad},
          .draws = hidden});
  EXPECT_EQ(readTexture<float>(color), cleared);
  // After a discard, a draw covers the whole target.
  const gpu::BufferRange near[] = {{.buffer = everything(0.6f)}};
  const gpu::Draw seen[] = {{.pipeline = pipeline, .vertexStreams = near, .count = 3}};
  const gpu::ColorTarget discard[] = {{.view = {.texture = color}, .load = Load::kDiscard}};
  render({.colors = discard,
          .depth = {.view = {.texture = depth}, .load = Load::kLoad},
          .draws = seen});
  EXPECT_EQ(readTexture<float>(color), std::vector<float>(kSize * kSize * 4, 1.0f));
}

TEST_P(Targets, OfEveryColourFormatAreCleared) {
  const auto first = [&](Format format, std::array<float, 4> value) {
    const gpu::Texture texture = target(format, 5);
    const gpu::ColorTarget colors[] = {{.view = {.texture = texture}, .clear = value}};
    render({.colors = colors});
    std::vector<std::byte> bytes = device().read(texture);
    const size_t texelBytes = gpu::formatInfo(format).texelBytes;
    EXPECT_EQ(bytes.size(), texelBytes * 25);
    for (size_t i = texelBytes; i < bytes.size(); ++i) EXPECT_EQ(bytes[i], bytes[i % texelBytes]);
    bytes.resize(texelBytes);
    return bytes;
  };
  const auto bytes = [](const auto& values) {
    const auto view = std::as_bytes(std::span(values));
    return std::vector<std::byte>(view.begin(), view.end());
  };
  using Floats = std::vector<float>;
  EXPECT_EQ(first(Format::kR8Unorm, {0.2f, 0, 0, 0}), bytes(std::vector<uint8_t>{51}));
  EXPECT_EQ(first(Format::kRgba8Unorm, {0.2f, 0.4f, 0.6f, 1}),
            bytes(std::vector<uint8_t>{51, 102, 153, 255}));
  EXPECT_EQ(first(Format::kRgba8Srgb, {0, 1, 0.21586050f, 0.2f}),  // 128 of 255 in sRGB
            bytes(std::vector<uint8_t>{0, 255, 128, 51}));
  EXPECT_EQ(first(Format::kR16Float, {1, 0, 0, 0}), bytes(std::vector<uint16_t>{0x3c00}));
  EXPECT_EQ(first(Format::kRgba16Float, {1, 0, -2, 0.5f}),
            bytes(std::vector<uint16_t>{0x3c00, 0, 0xc000, 0x3800}));
  EXPECT_EQ(first(Format::kR32Float, {0.1f, 0, 0, 0}), bytes(Floats{0.1f}));
  EXPECT_EQ(first(Format::kRg32Float, {0.1f, -7, 0, 0}), bytes(Floats{0.1f, -7}));
  EXPECT_EQ(first(Format::kRgba32Float, {0.1f, -7, 1e30f, 4}), bytes(Floats{0.1f, -7, 1e30f, 4}));
  EXPECT_EQ(first(Format::kR32Uint, {70000, 0, 0, 0}), bytes(std::vector<uint32_t>{70000}));
}

TEST_P(Targets, AreOneLevelOfOneLayer) {
  const gpu::Texture texture = makeTexture({.format = Format::kR32Float,
                                            .width = 8,
                                            .height = 6,
                                            .mips = 3,
                                            .layers = 2,
                                            .usage = TextureUsage::kTarget});
  for (uint32_t i = 0; i < 6; ++i) {
    const gpu::ColorTarget colors[] = {{.view = {.texture = texture, .mip = i % 3, .layer = i / 3},
                                        .clear = {static_cast<float>(i) + 1, 0, 0, 0}}};
    render({.colors = colors});
  }
  for (uint32_t i = 0; i < 6; ++i) {
    const size_t texels = size_t{8u >> i % 3} * (6u >> i % 3);
    EXPECT_EQ(readTexture<float>(texture, i % 3, i / 3),
              std::vector<float>(texels, static_cast<float>(i) + 1));
  }
}

// A later render call of the same frame samples the result of an earlier one.
TEST_P(Targets, AreSampledByLaterWork) {
  const Format formats[] = {Format::kRgba32Float};
  const gpu::Texture a = target(formats[0]), b = target(formats[0]);
  const gpu::GraphicsPipeline textured = positionPipeline(&grisaille_shader_textured_frag, formats);
  const gpu::BufferRange streams[] = {{.buffer = everything()}};
  const gpu::Sampler sampler = makeSampler({.label = "nearest"});
  inFrame([&](gpu::Commands& commands) {
    commands.beginPass("both");
    const gpu::ColorTarget clear[] = {{.view = {.texture = a}, .clear = {1, 2, 3, 4}}};
    commands.render({.colors = clear});
    for (int i = 0; i < 3; ++i) {
      const gpu::Binding bindings[] = {
          gpu::textureBinding(0, {.texture = i % 2 == 0 ? a : b}, sampler)};
      const gpu::Draw draws[] = {
          {.pipeline = textured, .bindings = bindings, .vertexStreams = streams, .count = 3}};
      const gpu::ColorTarget colors[] = {{.view = {.texture = i % 2 == 0 ? b : a}}};
      commands.render({.colors = colors, .draws = draws});
    }
    commands.endPass();
  });
  const std::vector<float> texels = readTexture<float>(b);
  for (size_t i = 0; i < texels.size(); ++i) ASSERT_EQ(texels[i], static_cast<float>(i % 4 + 1));
}

}  // namespace
}  // namespace grisaille::tests
