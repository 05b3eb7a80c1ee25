// SPDX-License-Identifier: MIT
#include "tests/support/devices.h"

#include <algorithm>

#include "backends/backends.h"
#include "core/base/error.h"

namespace grisaille::tests {

namespace {

// NVIDIA's Vulkan driver 580 is unloaded with the last instance of a process. Once that has
// happened many times, it fails to load. A device that nothing uses keeps it loaded.
void keepLoaded(const TestDevice& device) {
  if (device.backend != "vulkan" || !device.driver.empty()) return;
  [[maybe_unused]] static const gpu::Device* const kept = backends::create("vulkan", {}).release();
}

bool hasDevice(const TestDevice& device) {
  const DriverScope scope(device);
  try {
    const auto list = backends::find(device.backend).list();
    if (!list.empty() && !list.front().software) keepLoaded(device);
    return !list.empty();
  } catch (const Error& error) {
    if (error.id() != ErrorId::kBackendMissing) throw;
    return false;
  }
}

std::vector<TestDevice> presentOf(std::vector<TestDevice> list) {
  std::erase_if(list, [](const TestDevice& device) { return !whyAbsent(device).empty(); });
  return list;
}

}  // namespace

std::vector<TestDevice> presentDevices() {
  return presentOf(testDevices());
}

std::vector<TestDevice> presentSystemDevices() {
  return presentOf({systemOpenGl(), systemVulkan()});
}

std::string whyAbsent(const TestDevice& device) {
  std::string why = whyMissing(device);
  if (why.empty() && !hasDevice(device)) why = "this machine has no device for " + device.label;
  return why;
}

std::unique_ptr<gpu::Device> openDevice(const TestDevice& device, bool timed) {
  const DriverScope scope(device);
  gpu::DeviceOptions options;
  options.check = true;
  options.timed = timed;
  options.message = [label = device.label](gpu::Severity severity, std::string_view text) {
    ADD_FAILURE() << label << " says (severity " << static_cast<int>(severity) << "): " << text;
  };
  return backends::create(device.backend, options);
}

void BackendTest::SetUp() {
  const std::string why = whyAbsent(GetParam());
  if (!why.empty()) GTEST_SKIP() << why;
  driver_ = std::make_unique<DriverScope>(GetParam());
  device_ = openDevice(GetParam());
}

void BackendTest::TearDown() {
  closeDevice();
  driver_.reset();
}

void BackendTest::closeDevice() {
  if (device_ == nullptr) return;
  device_->abandon();
  for (auto destroy = destroy_.rbegin(); destroy != destroy_.rend(); ++destroy)
    (*destroy)(*device_);
  destroy_.clear();
  device_.reset();
}

void BackendTest::reopenTimed() {
  closeDevice();
  device_ = openDevice(GetParam(), true);
}

const Snapping& BackendTest::snapping() {
  if (!snapping_) snapping_ = measureSnapping(device());
  return *snapping_;
}

gpu::Buffer BackendTest::makeBuffer(uint64_t size, gpu::BufferUsage usage) {
  const gpu::Buffer buffer =
      device().createBuffer({.label = "test buffer", .size = size, .usage = usage});
  destroy_.push_back([buffer](gpu::Device& owner) { owner.destroy(buffer); });
  return buffer;
}

gpu::Texture BackendTest::makeTexture(gpu::TextureDesc desc) {
  if (desc.label.empty()) desc.label = "test texture";
  const gpu::Texture texture = device().createTexture(desc);
  destroy_.push_back([texture](gpu::Device& owner) { owner.destroy(texture); });
  return texture;
}

gpu::Sampler BackendTest::makeSampler(const gpu::SamplerDesc& desc) {
  const gpu::Sampler sampler = device().createSampler(desc);
  destroy_.push_back([sampler](gpu::Device& owner) { owner.destroy(sampler); });
  return sampler;
}

gpu::ComputePipeline BackendTest::makeCompute(const gpu::Shader& shader,
                                              std::span<const gpu::Specialization> constants) {
  const gpu::ComputePipeline pipeline = device().createComputePipeline(
      {.label = shader.name, .shader = &shader, .constants = constants});
  destroy_.push_back([pipeline](gpu::Device& owner) { owner.destroy(pipeline); });
  return pipeline;
}

gpu::GraphicsPipeline BackendTest::makeGraphics(gpu::GraphicsPipelineDesc desc) {
  if (desc.label.empty()) desc.label = "test pipeline";
  const gpu::GraphicsPipeline pipeline = device().createGraphicsPipeline(desc);
  destroy_.push_back([pipeline](gpu::Device& owner) { owner.destroy(pipeline); });
  return pipeline;
}

void BackendTest::inFrame(const std::function<void(gpu::Commands&)>& record) {
  record(device().begin());
  device().submit();
}

void BackendTest::compute(const gpu::Dispatch& dispatch) {
  inFrame([&](gpu::Commands& commands) {
    commands.beginPass("compute");
    commands.dispatch(dispatch);
    commands.endPass();
  });
}

void BackendTest::render(const gpu::Render& render) {
  inFrame([&](gpu::Commands& commands) {
    commands.beginPass("render");
    commands.render(render);
    commands.endPass();
  });
}

}  // namespace grisaille::tests
