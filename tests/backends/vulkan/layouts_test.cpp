// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "shaders/both_ways_comp.h"
#include "tests/backends/vulkan/fixture.h"

namespace grisaille::vulkan {
namespace {

class Layouts : public WithDevice {};
GRISAILLE_ON_EVERY_VULKAN_DEVICE(Layouts);

// The sampled views and the image share subresources: one layout must serve both.
TEST_P(Layouts, OneCallReadsATextureBothWays) {
  const std::unique_ptr<gpu::Device> device = open();
  const gpu::Texture texture =
      device->createTexture({.label = "both",
                             .format = gpu::Format::kR32Float,
                             .width = 8,
                             .height = 1,
                             .mips = 2,
                             .usage = gpu::TextureUsage::kSampled | gpu::TextureUsage::kStorage});
  const gpu::Sampler sampler = device->createSampler({.label = "nearest"});
  const gpu::Buffer out =
      device->createBuffer({.label = "out", .size = 128, .usage = gpu::BufferUsage::kStorage});
  const gpu::ComputePipeline pipeline = device->createComputePipeline(
      {.label = "both ways", .shader = &grisaille_shader_both_ways_comp});

  const std::array<float, 8> fine = {0, 1, 2, 3, 4, 5, 6, 7};
  const std::array<float, 4> coarse = {10, 11, 12, 13};
  gpu::Commands& commands = device->begin();
  commands.upload(texture, 0, 0, std::as_bytes(std::span(fine)));
  commands.upload(texture, 1, 0, std::as_bytes(std::span(coarse)));
  const gpu::Binding bindings[] = {gpu::textureBinding(0, {.texture = texture}, sampler),
                                   gpu::textureBinding(1, {.texture = texture, .mip = 1}, sampler),
                                   gpu::imageBinding(0, texture),
                                   gpu::storageBinding(0, {.buffer = out})};
  commands.beginPass("both");
  commands.dispatch({.pipeline = pipeline, .bindings = bindings});
  commands.endPass();
  device->submit();

  const std::vector<std::byte> bytes = device->read(gpu::BufferRange{.buffer = out});
  std::array<std::array<float, 4>, 8> values{};
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::byte*>(values.data()));
  for (size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(values[i][0], fine[i]);
    EXPECT_EQ(values[i][1], coarse[i / 2]);
    EXPECT_EQ(values[i][2], fine[i]);
  }
}

}  // namespace
}  // namespace grisaille::vulkan
