// SPDX-License-Identifier: MIT
#include <bit>

#include "shaders/constants_comp.h"
#include "shaders/copy_comp.h"
#include "shaders/downsample_comp.h"
#include "shaders/image_array_comp.h"
#include "shaders/image_step_comp.h"
#include "shaders/image_write_comp.h"
#include "shaders/step_comp.h"
#include "tests/support/devices.h"

namespace grisaille::tests {
namespace {

using gpu::BufferUsage;
using gpu::Format;
using gpu::TextureUsage;

class Compute : public BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(Compute);

uint32_t stepped(uint32_t value, int times) {
  for (int i = 0; i < times; ++i) value = value * 3 + 1;
  return value;
}

TEST_P(Compute, ConstantsOfEveryTypeAreSet) {
  const gpu::Buffer out = makeBuffer(16, BufferUsage::kStorage);
  const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = out})};
  const auto result = [&](std::span<const gpu::Specialization> constants) {
    compute({.pipeline = makeCompute(grisaille_shader_constants_comp, constants),
             .bindings = bindings});
    return readBuffer<uint32_t>({.buffer = out});
  };
  using Words = std::vector<uint32_t>;
  EXPECT_EQ(result({}), (Words{7, static_cast<uint32_t>(-7), std::bit_cast<uint32_t>(0.25f), 0}));
  for (const float real : {1.0f / 3, -0.0f, 1e-38f, 3.4e38f}) {
    const gpu::Specialization constants[] = {{.id = 0, .bits = 0xffffffffu},
                                             {.id = 3, .bits = static_cast<uint32_t>(-123456)},
                                             {.id = 5, .bits = std::bit_cast<uint32_t>(real)},
                                             {.id = 9, .bits = 1}};
    EXPECT_EQ(result(constants), (Words{0xffffffffu, static_cast<uint32_t>(-123456),
                                        std::bit_cast<uint32_t>(real), 1}));
  }
  const gpu::Specialization one[] = {{.id = 3, .bits = 5}};
  EXPECT_EQ(result(one), (Words{7, 5, std::bit_cast<uint32_t>(0.25f), 0}));
}

TEST_P(Compute, ImagesAreWrittenByTexel) {
  const gpu::Texture texture = makeTexture(
      {.format = Format::kR32Uint, .width = 37, .height = 19, .usage = TextureUsage::kStorage});
  const gpu::Binding bindings[] = {gpu::imageBinding(0, texture)};
  compute({.pipeline = makeCompute(grisaille_shader_image_write_comp),
           .bindings = bindings,
           .groups = {5, 3, 1}});
  const std::vector<uint32_t> texels = readTexture<uint32_t>(texture);
  for (uint32_t i = 0; i < 37 * 19; ++i) ASSERT_EQ(texels[i], i / 37 * 65536 + i % 37);
}

TEST_P(Compute, ImageArraysAreWrittenByLayer) {
  const gpu::Texture texture = makeTexture({.format = Format::kR32Uint,
                                            .width = 9,
                                            .height = 10,
                                            .mips = 2,
                                            .layers = 4,
                                            .usage = TextureUsage::kStorage});
  for (uint32_t mip = 0; mip < 2; ++mip) {
    const gpu::Binding bindings[] = {gpu::imageBinding(0, texture, mip)};
    compute({.pipeline = makeCompute(grisaille_shader_image_array_comp),
             .bindings = bindings,
             .groups = {2, 2, 4}});
  }
  for (uint32_t mip = 0; mip < 2; ++mip) {
    for (uint32_t layer = 0; layer < 4; ++layer) {
      const std::vector<uint32_t> texels = readTexture<uint32_t>(texture, mip, layer);
      const uint32_t width = 9u >> mip;
      for (uint32_t i = 0; i < texels.size(); ++i) {
        ASSERT_EQ(texels[i], layer * 1000000 + i / width * 1000 + i % width);
      }
    }
  }
}

TEST_P(Compute, OneLayerOfAnImageArrayIs2D) {
  const gpu::Texture texture = makeTexture({.format = Format::kR32Uint,
                                            .width = 8,
                                            .height = 8,
                                            .layers = 3,
                                            .usage = TextureUsage::kStorage});
  gpu::Binding layer = gpu::imageBinding(0, texture);
  layer.view.layer = 1;
  layer.view.layerCount = 1;
  for (uint32_t i = 0; i < 3; ++i) fill(texture, std::vector<uint32_t>(64, i), 0, i);
  compute({.pipeline = makeCompute(grisaille_shader_image_step_comp), .bindings = {&layer, 1}});
  EXPECT_EQ(readTexture<uint32_t>(texture, 0, 0), std::vector<uint32_t>(64, 0));
  EXPECT_EQ(readTexture<uint32_t>(texture, 0, 1), std::vector<uint32_t>(64, stepped(1, 1)));
  EXPECT_EQ(readTexture<uint32_t>(texture, 0, 2), std::vector<uint32_t>(64, 2));
}

// Each dispatch reads level n and writes level n + 1, all in one pass: each waits for the one
// before.
TEST_P(Compute, AMipChainIsBuiltLevelByLevel) {
  constexpr uint32_t kSize = 256, kMips = 9;
  const gpu::Texture texture =
      makeTexture({.format = Format::kR32Float,
                   .width = kSize,
                   .height = kSize,
                   .mips = kMips,
                   .usage = TextureUsage::kSampled | TextureUsage::kStorage});
  const gpu::ComputePipeline pipeline = makeCompute(grisaille_shader_downsample_comp);
  const gpu::Sampler sampler = makeSampler({.label = "nearest"});
  for (uint32_t round = 0; round < 3; ++round) {
    std::vector<float> expected;
    for (uint32_t i = 0; i < kSize * kSize; ++i) {
      expected.push_back(static_cast<float>((i * 2654435761u + round * 97) >> 20));
    }
    inFrame([&](gpu::Commands& commands) {
      commands.upload(texture, 0, 0, std::as_bytes(std::span(expected)));
      commands.beginPass("chain");
      for (uint32_t mip = 1; mip < kMips; ++mip) {
        const gpu::Binding bindings[] = {
            gpu::textureBinding(0, {.texture = texture, .mip = mip - 1, .mipCount = 1}, sampler),
            gpu::imageBinding(0, texture, mip)};
        const uint32_t groups = ((kSize >> mip) + 7) / 8;
        commands.dispatch(
            {.pipeline = pipeline, .bindings = bindings, .groups = {groups, groups, 1}});
      }
      commands.endPass();
    });
    for (uint32_t mip = 1; mip < kMips; ++mip) {
      const uint32_t size = kSize >> mip;
      std::vector<float> next(size * size);
      for (uint32_t i = 0; i < next.size(); ++i) {
        const size_t at = size_t{i / size} * 2 * size * 2 + i % size * 2;
        next[i] = (expected[at] + expected[at + 1] + expected[at + size * 2] +
                   expected[at + size * 2 + 1]) /
                  4;
      }
      expected = next;
      const std::vector<float> texels = readTexture<float>(texture, mip);
      ASSERT_EQ(texels.size(), expected.size());
      for (size_t i = 0; i < texels.size(); ++i) ASSERT_NEAR(texels[i], expected[i], 0.01) << mip;
    }
  }
}

TEST_P(Compute, AChainOfDispatchesKeepsItsOrder) {
  const gpu::Buffer buffer = bufferOf(std::vector<uint32_t>(4096, 1), BufferUsage::kStorage);
  const gpu::ComputePipeline pipeline = makeCompute(grisaille_shader_step_comp);
  const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = buffer})};
  for (int frame = 0; frame < 10; ++frame) {
    inFrame([&](gpu::Commands& commands) {
      commands.beginPass("chain");
      for (int i = 0; i < 50; ++i) {
        commands.dispatch({.pipeline = pipeline, .bindings = bindings, .groups = {64, 1, 1}});
      }
      commands.endPass();
    });
  }
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = buffer}), std::vector<uint32_t>(4096, stepped(1, 500)));
}

TEST_P(Compute, AnImageThatIsReadAndWrittenKeepsItsOrder) {
  const gpu::Texture texture = makeTexture(
      {.format = Format::kR32Uint, .width = 64, .height = 64, .usage = TextureUsage::kStorage});
  fill(texture, std::vector<uint32_t>(64 * 64, 2));
  const gpu::ComputePipeline pipeline = makeCompute(grisaille_shader_image_step_comp);
  const gpu::Binding bindings[] = {gpu::imageBinding(0, texture)};
  for (int frame = 0; frame < 5; ++frame) {
    inFrame([&](gpu::Commands& commands) {
      commands.beginPass("chain");
      for (int i = 0; i < 20; ++i) {
        commands.dispatch({.pipeline = pipeline, .bindings = bindings, .groups = {8, 8, 1}});
      }
      commands.endPass();
    });
  }
  EXPECT_EQ(readTexture<uint32_t>(texture), std::vector<uint32_t>(64 * 64, stepped(2, 100)));
}

// Read after write and write after read: two buffers alternate.
TEST_P(Compute, PingPongBetweenBuffers) {
  constexpr uint32_t kCount = 8192;
  const gpu::Buffer buffers[] = {bufferOf(std::vector<uint32_t>(kCount, 0), BufferUsage::kStorage),
                                 makeBuffer(kCount * 4, BufferUsage::kStorage)};
  const gpu::ComputePipeline pipeline = makeCompute(grisaille_shader_copy_comp);
  constexpr int kRounds = 31;
  const auto turn = [&](gpu::Commands& commands, int i) {
    const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = buffers[i % 2]}),
                                     gpu::storageBinding(1, {.buffer = buffers[(i + 1) % 2]})};
    commands.dispatch({.pipeline = pipeline, .bindings = bindings, .groups = {kCount / 64, 1, 1}});
  };
  inFrame([&](gpu::Commands& commands) {
    for (int i = 0; i < 20; ++i) {
      commands.beginPass("turn");
      turn(commands, i);
      commands.endPass();
    }
  });
  for (int i = 20; i < kRounds; ++i) {
    inFrame([&](gpu::Commands& commands) {
      commands.beginPass("turn");
      turn(commands, i);
      commands.endPass();
    });
  }
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = buffers[kRounds % 2]}),
            std::vector<uint32_t>(kCount, (uint32_t{1} << kRounds) - 1));
}

// A dispatch reads uploads recorded before it, and none recorded after it.
TEST_P(Compute, UploadsBetweenDispatchesKeepTheirOrder) {
  constexpr uint32_t kCount = 1024;
  const gpu::Buffer source = makeBuffer(kCount * 4, BufferUsage::kStorage);
  const gpu::ComputePipeline pipeline = makeCompute(grisaille_shader_copy_comp);
  std::vector<gpu::Buffer> results;
  for (int i = 0; i < 8; ++i) results.push_back(makeBuffer(kCount * 4, BufferUsage::kStorage));
  inFrame([&](gpu::Commands& commands) {
    for (uint32_t i = 0; i < results.size(); ++i) {
      const std::vector<uint32_t> values(kCount, i);
      commands.upload(source, 0, std::as_bytes(std::span(values)));
      const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = source}),
                                       gpu::storageBinding(1, {.buffer = results[i]})};
      commands.beginPass("copy");
      commands.dispatch(
          {.pipeline = pipeline, .bindings = bindings, .groups = {kCount / 64, 1, 1}});
      commands.endPass();
    }
  });
  for (uint32_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(readBuffer<uint32_t>({.buffer = results[i]}),
              std::vector<uint32_t>(kCount, i * 2 + 1));
  }
}

}  // namespace
}  // namespace grisaille::tests
