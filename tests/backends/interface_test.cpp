// SPDX-License-Identifier: MIT
// Features for drawing a user interface: blending, scissors, colours in bytes.
#include <cmath>
#include <cstring>

#include "tests/backends/scene.h"

namespace grisaille::tests {
namespace {

using gpu::Blend;
using gpu::Format;
using Color = std::array<float, 4>;

class Interface : public RasterTest {
 protected:
  gpu::GraphicsPipeline paintPipeline(std::span<const Format> formats, Blend blend) {
    static constexpr uint32_t kStrides[] = {12};
    static constexpr gpu::VertexAttribute kAttributes[] = {{.location = 0}};
    return makeGraphics({.vertex = &grisaille_shader_position_vert,
                         .fragment = &grisaille_shader_uniform_color_frag,
                         .streamStrides = kStrides,
                         .attributes = kAttributes,
                         .colorFormats = formats,
                         .blend = blend});
  }

  // One draw in one colour, with its own pipeline and scissor. paint() records a list in order.
  struct Paint {
    Color color;
    gpu::GraphicsPipeline pipeline;
    gpu::Scissor scissor = {};
  };
  void paint(const gpu::ColorTarget& target, const std::vector<Paint>& paints) {
    const gpu::BufferRange streams[] = {{.buffer = triangle()}};
    inFrame([&](gpu::Commands& commands) {
      std::vector<gpu::Binding> bindings;
      for (const Paint& one : paints) {
        bindings.push_back(
            gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(one.color)))));
      }
      std::vector<gpu::Draw> draws;
      for (size_t i = 0; i < paints.size(); ++i) {
        draws.push_back({.pipeline = paints[i].pipeline,
                         .bindings = {&bindings[i], 1},
                         .vertexStreams = streams,
                         .count = 3,
                         .scissor = paints[i].scissor});
      }
      commands.beginPass("paint");
      commands.render({.colors = {&target, 1}, .draws = draws});
      commands.endPass();
    });
  }

 private:
  gpu::Buffer triangle() {
    if (!triangle_) triangle_ = everything();
    return triangle_;
  }
  gpu::Buffer triangle_;
};
GRISAILLE_ON_EVERY_DEVICE(Interface);

TEST_P(Interface, OverIsByStraightAlpha) {
  constexpr Color kHeld = {0.2f, 0.4f, 0.8f, 0.6f}, kNew = {0.8f, 0, 0.4f, 0.25f};
  for (const Format format : {Format::kRgba8Unorm, Format::kRgba16Float}) {
    const Format formats[] = {format};
    const gpu::Texture texture = target(format);
    const gpu::GraphicsPipeline over = paintPipeline(formats, Blend::kOver);
    paint({.view = {.texture = texture}, .clear = kHeld}, {{.color = kNew, .pipeline = over}});
    const std::vector<std::byte> bytes = device().read(texture);
    for (size_t i = 0; i < 4; ++i) {
      const float part = i < 3 ? kNew[i] * kNew[3] : kNew[3];
      const float expected = part + kHeld[i] * (1 - kNew[3]);
      float there = 0;
      if (format == Format::kRgba8Unorm) {
        there = static_cast<float>(bytes[i]) / 255;
      } else {
        uint16_t half = 0;  // positive and normal in this range
        std::memcpy(&half, &bytes[i * 2], 2);
        there = std::ldexp(1.0f + static_cast<float>(half & 1023u) / 1024, (half >> 10) - 15);
      }
      EXPECT_NEAR(there, expected, 1.01f / 255) << gpu::formatInfo(format).name << " " << i;
    }
  }
}

// Within one render call, independent of the previous draw's blending.
TEST_P(Interface, EveryDrawBlendsAsItsPipelineSays) {
  const Format formats[] = {Format::kRgba8Unorm};
  const gpu::Texture texture = target(formats[0]);
  const gpu::GraphicsPipeline over = paintPipeline(formats, Blend::kOver);
  const gpu::GraphicsPipeline none = paintPipeline(formats, Blend::kNone);
  const gpu::Scissor right{kSize / 2, 0, kSize / 2, kSize};
  paint({.view = {.texture = texture}, .clear = {0, 0, 1, 1}},
        {{.color = {1, 0, 0, 0.4f}, .pipeline = over},
         {.color = {1, 0, 0, 0.4f}, .pipeline = none, .scissor = right},
         {.color = {0, 1, 0, 0}, .pipeline = over}});
  const std::vector<uint8_t> texels = readTexture<uint8_t>(texture);
  const std::array<uint8_t, 8> expected = {102, 0, 153, 255, 255, 0, 0, 102};
  for (size_t i = 0; i < texels.size(); ++i) {
    const bool isRight = i / 4 % kSize >= kSize / 2;
    ASSERT_NEAR(texels[i], expected[i % 4 + (isRight ? 4 : 0)], 1) << i;
  }
}

TEST_P(Interface, ScissorsCountFromTheTopLeft) {
  const Format formats[] = {Format::kRgba8Unorm};
  const gpu::GraphicsPipeline none = paintPipeline(formats, Blend::kNone);
  const gpu::Texture texture = target(formats[0]);
  for (const gpu::Scissor& scissor : std::vector<gpu::Scissor>{
           {3, 5, 7, 2}, {0, 0, 1, 1}, {kSize - 1, kSize - 1, 1, 1}, {0, 0, kSize, kSize}, {}}) {
    // The clear ignores scissors, including the scissor of the call before.
    paint({.view = {.texture = texture}, .clear = {0, 0, 1, 0}},
          {{.color = {1, 0, 0, 0}, .pipeline = none, .scissor = scissor}});
    const std::vector<uint32_t> texels = readTexture<uint32_t>(texture);
    for (uint32_t i = 0; i < texels.size(); ++i) {
      const uint32_t x = i % kSize, y = i / kSize;
      const bool inside = scissor.width == 0 || (x >= scissor.x && x < scissor.x + scissor.width &&
                                                 y >= scissor.y && y < scissor.y + scissor.height);
      ASSERT_EQ(texels[i], inside ? 0x0000ffu : 0xff0000u) << x << ", " << y;
    }
  }
}

TEST_P(Interface, BytesAreColours) {
  const Format formats[] = {Format::kRgba32Float};
  const uint32_t strides[] = {16};
  const gpu::VertexAttribute attributes[] = {
      {.location = 0}, {.location = 1, .format = gpu::AttributeFormat::kUnorm8x4, .offset = 12}};
  const gpu::GraphicsPipeline pipeline = makeGraphics({.vertex = &grisaille_shader_colored_vert,
                                                       .fragment = &grisaille_shader_colored_frag,
                                                       .streamStrides = strides,
                                                       .attributes = attributes,
                                                       .colorFormats = formats});
  float color = 0;
  const std::array<uint8_t, 4> bytes = {255, 51, 0, 128};
  std::memcpy(&color, bytes.data(), 4);
  const gpu::BufferRange streams[] = {
      {.buffer = vertices({-1, -3, 0.5f, color, 3, 1, 0.5f, color, -1, 1, 0.5f, color})}};
  const gpu::Texture texture = target(formats[0]);
  const gpu::Draw draws[] = {{.pipeline = pipeline, .vertexStreams = streams, .count = 3}};
  const gpu::ColorTarget colors[] = {{.view = {.texture = texture}}};
  render({.colors = colors, .draws = draws});
  const std::vector<float> texels = readTexture<float>(texture);
  for (size_t i = 0; i < texels.size(); ++i) {
    ASSERT_NEAR(texels[i], static_cast<float>(bytes[i % 4]) / 255, 1e-6) << i;
  }
}

}  // namespace
}  // namespace grisaille::tests
