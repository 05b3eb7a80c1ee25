// SPDX-License-Identifier: MIT
#include "shaders/copy_comp.h"
#include "shaders/fetch_comp.h"
#include "shaders/image_step_comp.h"
#include "shaders/image_write_comp.h"
#include "shaders/step_comp.h"
#include "shaders/uniform_value_comp.h"
#include "tests/support/devices.h"
#include "tests/support/expect_error.h"

namespace grisaille::tests {
namespace {

using gpu::BufferUsage;
using gpu::Format;
using gpu::TextureUsage;

class Frames : public BackendTest {
 protected:
  // Dispatches `data[index] = value`, with the uniform block in the frame's memory.
  void setValue(gpu::Commands& commands, gpu::Buffer out, gpu::ComputePipeline pipeline,
                uint32_t index, uint32_t value) {
    const std::array<uint32_t, 4> block = {index, value, 0, 0};
    const gpu::Binding bindings[] = {
        gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(block)))),
        gpu::storageBinding(0, {.buffer = out})};
    commands.beginPass("set");
    commands.dispatch({.pipeline = pipeline, .bindings = bindings});
    commands.endPass();
  }
};
GRISAILLE_ON_EVERY_DEVICE(Frames);

TEST_P(Frames, UniformsOfFramesInFlightStayApart) {
  constexpr uint32_t kFrames = 300, kPerFrame = 7;
  const gpu::Buffer out =
      bufferOf(std::vector<uint32_t>(kFrames * kPerFrame, 0), BufferUsage::kStorage);
  const gpu::ComputePipeline pipeline = makeCompute(grisaille_shader_uniform_value_comp);
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    inFrame([&](gpu::Commands& commands) {
      for (uint32_t i = 0; i < kPerFrame; ++i) {
        const uint32_t index = frame * kPerFrame + i;
        setValue(commands, out, pipeline, index, index * 31 + 5);
      }
    });
  }
  const std::vector<uint32_t> values = readBuffer<uint32_t>({.buffer = out});
  for (uint32_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], i * 31 + 5);
}

TEST_P(Frames, ManyLargeUniformsOfOneFrameStayApart) {
  constexpr uint32_t kCount = 200;  // of 64 KiB each, more than any initial size of that memory
  const gpu::Buffer out = bufferOf(std::vector<uint32_t>(kCount, 0), BufferUsage::kStorage);
  const gpu::ComputePipeline pipeline = makeCompute(grisaille_shader_uniform_value_comp);
  for (int round = 0; round < 3; ++round) {
    inFrame([&](gpu::Commands& commands) {
      std::vector<uint32_t> block(16384, 0);
      commands.beginPass("set");
      for (uint32_t i = 0; i < kCount; ++i) {
        block[0] = i;
        block[1] = i + 1000;
        const gpu::Binding bindings[] = {
            gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(block)))),
            gpu::storageBinding(0, {.buffer = out})};
        commands.dispatch({.pipeline = pipeline, .bindings = bindings});
      }
      commands.endPass();
    });
  }
  const std::vector<uint32_t> values = readBuffer<uint32_t>({.buffer = out});
  for (uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(values[i], i + 1000);
}

TEST_P(Frames, TransientTexturesServeFrameAfterFrame) {
  const gpu::ComputePipeline write = makeCompute(grisaille_shader_image_write_comp);
  const gpu::ComputePipeline step = makeCompute(grisaille_shader_image_step_comp);
  for (uint32_t frame = 0; frame < 20; ++frame) {
    inFrame([&](gpu::Commands& commands) {
      gpu::TextureDesc desc{.label = "transient",
                            .format = Format::kR32Uint,
                            .width = 16 + frame / 5,
                            .height = 16,
                            .usage = TextureUsage::kStorage};
      const gpu::Texture a = commands.transient(desc), b = commands.transient(desc);
      EXPECT_NE(a, b);
      for (const gpu::Texture texture : {a, b}) {
        const gpu::Binding bindings[] = {gpu::imageBinding(0, texture)};
        commands.beginPass("write and step");
        commands.dispatch({.pipeline = write, .bindings = bindings, .groups = {3, 2, 1}});
        commands.dispatch({.pipeline = step, .bindings = bindings, .groups = {3, 2, 1}});
        commands.endPass();
      }
    });
  }
}

// Copies of transient contents in a persistent buffer stay intact while later frames reuse the
// memory.
TEST_P(Frames, TransientMemoryIsNotReusedTooEarly) {
  constexpr uint32_t kFrames = 24, kTexels = 64 * 64;
  const gpu::ComputePipeline fetch = makeCompute(grisaille_shader_fetch_comp);
  const gpu::Sampler sampler = makeSampler({.label = "nearest"});
  const gpu::Buffer out = makeBuffer(kFrames * kTexels * 4, BufferUsage::kStorage);
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    inFrame([&](gpu::Commands& commands) {
      const gpu::Texture texture = commands.transient({.label = "transient",
                                                       .format = Format::kR32Float,
                                                       .width = 64,
                                                       .height = 64,
                                                       .usage = TextureUsage::kSampled});
      const std::vector<float> values(kTexels, static_cast<float>(frame) + 0.5f);
      commands.upload(texture, 0, 0, std::as_bytes(std::span(values)));
      const gpu::Binding bindings[] = {
          gpu::textureBinding(0, {.texture = texture}, sampler),
          gpu::storageBinding(0,
                              {.buffer = out, .offset = frame * kTexels * 4, .size = kTexels * 4})};
      commands.beginPass("fetch");
      commands.dispatch({.pipeline = fetch, .bindings = bindings, .groups = {8, 8, 1}});
      commands.endPass();
    });
  }
  const std::vector<float> values = readBuffer<float>({.buffer = out});
  for (uint32_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(values[i], static_cast<float>(i / kTexels) + 0.5f);
  }
}

TEST_P(Frames, ResourcesMayGoWhileInFlight) {
  const gpu::Buffer result = bufferOf(std::vector<uint32_t>(1024, 0), BufferUsage::kStorage);
  for (uint32_t round = 0; round < 40; ++round) {
    const gpu::Buffer source = device().createBuffer(
        {.label = "short-lived", .size = 4096, .usage = BufferUsage::kStorage});
    const gpu::Texture texture = device().createTexture({.label = "short-lived",
                                                         .format = Format::kR32Uint,
                                                         .width = 64,
                                                         .height = 64,
                                                         .usage = TextureUsage::kStorage});
    const gpu::ComputePipeline copy = device().createComputePipeline(
        {.label = "short-lived", .shader = &grisaille_shader_copy_comp});
    const gpu::ComputePipeline write = device().createComputePipeline(
        {.label = "short-lived", .shader = &grisaille_shader_image_write_comp});
    inFrame([&](gpu::Commands& commands) {
      const std::vector<uint32_t> values(1024, round);
      commands.upload(source, 0, std::as_bytes(std::span(values)));
      commands.beginPass("use");
      const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = source}),
                                       gpu::storageBinding(1, {.buffer = result})};
      commands.dispatch({.pipeline = copy, .bindings = bindings, .groups = {16, 1, 1}});
      const gpu::Binding image[] = {gpu::imageBinding(0, texture)};
      commands.dispatch({.pipeline = write, .bindings = image, .groups = {8, 8, 1}});
      commands.endPass();
    });
    device().destroy(source);
    device().destroy(texture);
    device().destroy(copy);
    device().destroy(write);
  }
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = result}), std::vector<uint32_t>(1024, 79));
}

TEST_P(Frames, AnAbandonedFrameLeavesNoTrace) {
  const gpu::Buffer buffer = bufferOf(std::vector<uint32_t>(64, 1), BufferUsage::kStorage);
  const gpu::Texture texture = makeTexture(
      {.format = Format::kR32Uint, .width = 8, .height = 8, .usage = TextureUsage::kStorage});
  fill(texture, std::vector<uint32_t>(64, 1));
  const gpu::ComputePipeline step = makeCompute(grisaille_shader_step_comp);
  const gpu::ComputePipeline imageStep = makeCompute(grisaille_shader_image_step_comp);
  const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = buffer})};
  const gpu::Binding image[] = {gpu::imageBinding(0, texture)};
  for (int round = 0; round < 3; ++round) {
    gpu::Commands& commands = device().begin();
    commands.transient({.label = "dropped",
                        .format = Format::kR32Float,
                        .width = 4,
                        .height = 4,
                        .usage = TextureUsage::kStorage});
    commands.beginPass("left open");
    device().abandon();
    inFrame([&](gpu::Commands& next) {
      next.beginPass("step");
      next.dispatch({.pipeline = step, .bindings = bindings});
      next.dispatch({.pipeline = imageStep, .bindings = image});
      next.endPass();
    });
  }
  device().abandon();  // no frame is being recorded: does nothing
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = buffer}), std::vector<uint32_t>(64, 40));
  EXPECT_EQ(readTexture<uint32_t>(texture), std::vector<uint32_t>(64, 40));
}

// Abandoning a frame reverts its uses, not the resources created or destroyed meanwhile.
TEST_P(Frames, WhatIsMadeAroundAnAbandonedFrameStays) {
  const gpu::ComputePipeline write = makeCompute(grisaille_shader_image_write_comp);
  const gpu::ComputePipeline step = makeCompute(grisaille_shader_image_step_comp);
  const gpu::TextureDesc desc{.label = "around",
                              .format = Format::kR32Uint,
                              .width = 64,
                              .height = 64,
                              .usage = TextureUsage::kStorage};
  const gpu::Texture doomed = device().createTexture(desc);
  const gpu::Texture before = makeTexture(desc);
  device().begin();
  const gpu::Texture within = makeTexture(desc);
  device().destroy(doomed);
  device().abandon();
  for (const gpu::Texture texture : {before, within}) {
    const gpu::Binding bindings[] = {gpu::imageBinding(0, texture)};
    inFrame([&](gpu::Commands& commands) {
      commands.beginPass("use");
      commands.dispatch({.pipeline = write, .bindings = bindings, .groups = {8, 8, 1}});
      commands.dispatch({.pipeline = step, .bindings = bindings, .groups = {8, 8, 1}});
      commands.endPass();
    });
    const std::vector<uint32_t> texels = readTexture<uint32_t>(texture);
    for (uint32_t i = 0; i < 64 * 64; ++i) ASSERT_EQ(texels[i], (i / 64 * 65536 + i % 64) * 3 + 1);
  }
}

TEST_P(Frames, EmptyFramesAndPassesAreAllowed) {
  for (int i = 0; i < 10; ++i) {
    inFrame([](gpu::Commands&) {});
    inFrame([](gpu::Commands& commands) {
      commands.beginPass("empty");
      commands.endPass();
    });
  }
  device().wait();
}

TEST_P(Frames, DestroyedHandlesAreStale) {
  const gpu::Buffer buffer =
      device().createBuffer({.label = "gone", .size = 4, .usage = BufferUsage::kStorage});
  device().destroy(buffer);
  const gpu::Buffer next =
      device().createBuffer({.label = "next", .size = 4, .usage = BufferUsage::kStorage});
  EXPECT_NE(buffer, next);
  EXPECT_ERROR(ErrorId::kStaleHandle, device().destroy(buffer));
  EXPECT_ERROR(ErrorId::kStaleHandle, (void)device().read(gpu::BufferRange{.buffer = buffer}));
  EXPECT_ERROR(ErrorId::kStaleHandle, (void)device().read(gpu::Texture{.value = 0x70007}));
  device().destroy(next);
  device().destroy(gpu::Buffer{});
  device().destroy(gpu::Texture{});
}

}  // namespace
}  // namespace grisaille::tests
