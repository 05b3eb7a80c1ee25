// SPDX-License-Identifier: MIT
#include <algorithm>

#include "backends/backends.h"
#include "shaders/fill_comp.h"
#include "shaders/step_comp.h"
#include "tests/support/devices.h"
#include "tests/support/expect_error.h"

namespace grisaille::tests {
namespace {

using gpu::BufferUsage;

TEST(Backends, AtLeastOneIsPresent) {
  EXPECT_FALSE(presentDevices().empty());
}

class Devices : public BackendTest {
 protected:
  const backends::Backend& backend() {
    for (const backends::Backend& one : backends::all()) {
      if (one.name == GetParam().backend) return one;
    }
    throw std::logic_error("the backend is not listed");
  }
};
GRISAILLE_ON_EVERY_DEVICE(Devices);

TEST_P(Devices, SayWhatTheyAre) {
  const gpu::DeviceInfo& info = device().info();
  EXPECT_EQ(info.backend, GetParam().backend);
  EXPECT_FALSE(info.name.empty());
  EXPECT_FALSE(info.driver.empty());
  EXPECT_EQ(info.clock, info.software ? gpu::Clock::kWall : gpu::Clock::kGpu);
  const gpu::Capabilities& can = info.capabilities;
  EXPECT_GE(can.maxTextureSize, 4096u);
  EXPECT_GE(can.maxTextureLayers, 256u);
  EXPECT_GE(can.maxBufferBytes, uint64_t{1} << 27);
  EXPECT_GE(can.maxStorageRange, uint64_t{1} << 27);
  EXPECT_GE(can.maxUniformRange, 65536u);
  EXPECT_GE(can.uniformAlignment, 1u);
  EXPECT_GE(can.storageAlignment, 1u);
  for (const uint32_t groups : can.maxGroups) EXPECT_GE(groups, 65535u);
  EXPECT_GE(can.maxAnisotropy, 1.0f);
}

TEST_P(Devices, AreChosenByNumberOrPartOfTheirName) {
  const std::vector<gpu::ListedDevice> listed = backend().list();
  ASSERT_FALSE(listed.empty());
  for (size_t i = 0; i < listed.size(); ++i) {
    gpu::DeviceOptions options;
    options.message = [](gpu::Severity, std::string_view text) { ADD_FAILURE() << text; };
    options.device = std::to_string(i);
    EXPECT_EQ(backend().create(options)->info().name, listed[i].name);
    options.device = listed[i].name.substr(0, 6);
    EXPECT_NE(backend().create(options)->info().name.find(options.device), std::string::npos);
  }
}

TEST_P(Devices, ThatAreNotThereAreRefused) {
  for (const char* name : {"no such device", "4096", "-1"}) {
    gpu::DeviceOptions options;
    options.device = name;
    EXPECT_ERROR(ErrorId::kNoDevice, (void)backend().create(options));
  }
}

// Without the checking layer, which makes the same check: drivers need not refuse the size; some
// crash.
TEST_P(Devices, TexturesOverTheLimitAreRefused) {
  const std::unique_ptr<gpu::Device> unchecked = backend().create({});
  const uint32_t most = unchecked->info().capabilities.maxTextureSize;
  for (const auto& [width, height] : {std::pair{most + 1, 1u}, {1u, most + 1}, {~0u, ~0u}}) {
    EXPECT_ERROR(ErrorId::kTextureSize,
                 (void)unchecked->createTexture({.label = "over",
                                                 .format = gpu::Format::kR8Unorm,
                                                 .width = width,
                                                 .height = height,
                                                 .usage = gpu::TextureUsage::kSampled}));
  }
}

TEST_P(Devices, TwoLiveSideBySide) {
  const std::unique_ptr<gpu::Device> other = openDevice(GetParam());
  gpu::Device* both[] = {&device(), other.get()};
  std::array<gpu::Buffer, 2> buffers;
  std::array<gpu::ComputePipeline, 2> pipelines;
  for (size_t i = 0; i < 2; ++i) {
    buffers[i] = both[i]->createBuffer(
        {.label = "side by side", .size = 256, .usage = BufferUsage::kStorage});
    pipelines[i] = both[i]->createComputePipeline(
        {.label = "side by side", .shader = &grisaille_shader_fill_comp});
  }
  for (uint32_t round = 0; round < 5; ++round) {
    // Both record at the same time, alternating.
    gpu::Commands* commands[] = {&both[0]->begin(), &both[1]->begin()};
    for (uint32_t i = 0; i < 2; ++i) commands[i]->beginPass("fill");
    for (uint32_t i = 0; i < 2; ++i) {
      const std::array<uint32_t, 4> block = {64, i + 1, round, 0};
      const gpu::Binding bindings[] = {
          gpu::uniformBinding(0, commands[i]->uniform(std::as_bytes(std::span(block)))),
          gpu::storageBinding(0, {.buffer = buffers[i]})};
      commands[i]->dispatch({.pipeline = pipelines[i], .bindings = bindings});
    }
    for (uint32_t i = 0; i < 2; ++i) commands[i]->endPass();
    for (uint32_t i = 0; i < 2; ++i) both[i]->submit();
  }
  for (uint32_t i = 0; i < 2; ++i) {
    const std::vector<std::byte> bytes = both[i]->read(gpu::BufferRange{.buffer = buffers[i]});
    std::vector<uint32_t> expected;
    for (uint32_t at = 0; at < 64; ++at) expected.push_back(at * (i + 1) + 4);
    const auto words = std::as_bytes(std::span(expected));
    EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), words.begin(), words.end()));
    both[i]->destroy(buffers[i]);
    both[i]->destroy(pipelines[i]);
  }
}

TEST_P(Devices, WithoutAWindowShowNothing) {
  const gpu::Texture picture = makeTexture({.format = gpu::Format::kRgba8Unorm,
                                            .width = 2,
                                            .height = 2,
                                            .usage = gpu::TextureUsage::kSampled});
  fill(picture, std::vector<uint32_t>(4));
  EXPECT_ERROR(ErrorId::kNoWindow, (void)device().present(picture));
}

TEST_P(Devices, RefuseABrokenShader) {
  gpu::Shader broken = grisaille_shader_fill_comp;
  broken.glsl = "#version 450\nthis is no shader\n";
  if (GetParam().backend == "vulkan") GTEST_SKIP() << "Vulkan drivers may trust their SPIR-V";
  EXPECT_ERROR(ErrorId::kShaderRefused,
               (void)device().createComputePipeline({.label = "broken", .shader = &broken}));
}

TEST_P(Devices, TimeEveryPassWhenAsked) {
  reopenTimed();
  const gpu::Buffer buffer = bufferOf(std::vector<uint32_t>(65536, 1), BufferUsage::kStorage);
  const gpu::ComputePipeline step = makeCompute(grisaille_shader_step_comp);
  const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = buffer})};
  device().wait();
  std::vector<gpu::FrameTimes> times = device().takeTimes();
  const uint64_t first = times.size();  // counts the upload's frame
  EXPECT_EQ(first, 1u);
  times.clear();
  constexpr uint64_t kFrames = 30;
  for (uint64_t frame = 0; frame < kFrames; ++frame) {
    inFrame([&](gpu::Commands& commands) {
      for (const char* label : {"one", "two", "one"}) {
        commands.beginPass(label);
        for (int i = 0; i < 4; ++i) {
          commands.dispatch({.pipeline = step, .bindings = bindings, .groups = {1024, 1, 1}});
        }
        commands.endPass();
      }
    });
    for (gpu::FrameTimes& taken : device().takeTimes()) times.push_back(std::move(taken));
  }
  device().wait();
  for (gpu::FrameTimes& taken : device().takeTimes()) times.push_back(std::move(taken));
  ASSERT_EQ(times.size(), kFrames);
  for (uint64_t frame = 0; frame < kFrames; ++frame) {
    EXPECT_EQ(times[frame].frame, first + frame);
    ASSERT_EQ(times[frame].passes.size(), 3u);
    EXPECT_EQ(times[frame].passes[0].label, "one");
    EXPECT_EQ(times[frame].passes[1].label, "two");
    EXPECT_EQ(times[frame].passes[2].label, "one");
    double sum = 0;
    for (const gpu::PassTime& pass : times[frame].passes) {
      EXPECT_GE(pass.milliseconds, 0);
      sum += pass.milliseconds;
    }
    EXPECT_GT(times[frame].wholeMilliseconds, 0);
    EXPECT_LE(sum, times[frame].wholeMilliseconds * 1.05);
  }
  EXPECT_TRUE(device().takeTimes().empty());
}

TEST_P(Devices, TimeNothingUnlessAsked) {
  inFrame([](gpu::Commands& commands) {
    commands.beginPass("pass");
    commands.endPass();
  });
  device().wait();
  EXPECT_TRUE(device().takeTimes().empty());
}

}  // namespace
}  // namespace grisaille::tests
