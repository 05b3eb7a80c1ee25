// SPDX-License-Identifier: MIT
// Devices for tests. The checking layer is on, and any message of the device or its driver fails
// the test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/gpu/device.h"
#include "tests/support/snapping.h"
#include "tests/support/test_device.h"

namespace grisaille::tests {

// The test devices that this machine has.
std::vector<TestDevice> presentDevices();

// The system's OpenGL and Vulkan devices; this machine may lack either.
std::vector<TestDevice> presentSystemDevices();

// Why a test of this device is skipped on this machine; "" if it runs.
std::string whyAbsent(const TestDevice& device);

// Opens a device with checks. Its messages fail the current test.
std::unique_ptr<gpu::Device> openDevice(const TestDevice& device, bool timed = false);

// A test that runs on every device of this machine and is skipped on the others. Resources from the
// make functions below are destroyed at the end of the test. During a test, new Vulkan instances of
// the process find the test's driver only.
class BackendTest : public ::testing::TestWithParam<TestDevice> {
 protected:
  void SetUp() override;
  void TearDown() override;

  gpu::Device& device() { return *device_; }
  // Measured on the test's device, once per test.
  const Snapping& snapping();
  // Closes the device and opens it again with timed passes.
  void reopenTimed();

  gpu::Buffer makeBuffer(uint64_t size, gpu::BufferUsage usage);
  gpu::Texture makeTexture(gpu::TextureDesc desc);
  gpu::Sampler makeSampler(const gpu::SamplerDesc& desc);
  gpu::ComputePipeline makeCompute(const gpu::Shader& shader,
                                   std::span<const gpu::Specialization> constants = {});
  gpu::GraphicsPipeline makeGraphics(gpu::GraphicsPipelineDesc desc);

  // Creates a buffer and uploads these values.
  template <typename T>
  gpu::Buffer bufferOf(const std::vector<T>& values, gpu::BufferUsage usage) {
    const gpu::Buffer buffer = makeBuffer(values.size() * sizeof(T), usage);
    inFrame([&](gpu::Commands& commands) {
      commands.upload(buffer, 0, std::as_bytes(std::span(values)));
    });
    return buffer;
  }

  // Uploads these values to one layer of one mip.
  template <typename T>
  void fill(gpu::Texture texture, const std::vector<T>& values, uint32_t mip = 0,
            uint32_t layer = 0) {
    inFrame([&](gpu::Commands& commands) {
      commands.upload(texture, mip, layer, std::as_bytes(std::span(values)));
    });
  }

  template <typename T>
  std::vector<T> readTexture(gpu::Texture texture, uint32_t mip = 0, uint32_t layer = 0) {
    return valuesOf<T>(device().read(texture, mip, layer));
  }
  template <typename T>
  std::vector<T> readBuffer(gpu::BufferRange range) {
    return valuesOf<T>(device().read(range));
  }

  // Records one frame and submits it.
  void inFrame(const std::function<void(gpu::Commands&)>& record);
  // Submits a frame with one pass that holds this dispatch.
  void compute(const gpu::Dispatch& dispatch);
  // Submits a frame with one pass that holds this render call.
  void render(const gpu::Render& render);

 private:
  template <typename T>
  static std::vector<T> valuesOf(const std::vector<std::byte>& bytes) {
    EXPECT_EQ(bytes.size() % sizeof(T), 0u);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::copy_n(bytes.data(), values.size() * sizeof(T),
                reinterpret_cast<std::byte*>(values.data()));
    return values;
  }
  void closeDevice();

  std::unique_ptr<DriverScope> driver_;
  std::unique_ptr<gpu::Device> device_;
  std::optional<Snapping> snapping_;
  std::vector<std::function<void(gpu::Device&)>> destroy_;
};

}  // namespace grisaille::tests

// Runs the tests of a BackendTest on every device.
#define GRISAILLE_ON_EVERY_DEVICE(Suite)                                                    \
  INSTANTIATE_TEST_SUITE_P(, Suite, ::testing::ValuesIn(::grisaille::tests::testDevices()), \
                           GRISAILLE_DEVICE_NAME)
