// SPDX-License-Identifier: MIT
#include "tests/support/devices.h"

#include <algorithm>

#include "backends/backends.h"
#include "core/error.h"

namespace grisaille::tests {

std::vector<std::string> backendNames() {
  std::vector<std::string> names;
  for (const backends::Backend& backend : backends::all()) names.emplace_back(backend.name);
  return names;
}

std::vector<std::string> presentBackends() {
  std::vector<std::string> present;
  for (const backends::Backend& backend : backends::all()) {
    try {
      if (!backend.list().empty()) present.emplace_back(backend.name);
    } catch (const Error& error) {
      if (error.id() != ErrorId::kBackendMissing) throw;
    }
  }
  return present;
}

std::unique_ptr<gpu::Device> openDevice(const std::string& backend, bool timed) {
  gpu::DeviceOptions options;
  options.check = true;
  options.timed = timed;
  options.message = [backend](gpu::Severity severity, std::string_view text) {
    ADD_FAILURE() << backend << " says (severity " << static_cast<int>(severity) << "): " << text;
  };
  return backends::create(backend, options);
}

void BackendTest::SetUp() {
  const std::vector<std::string> present = presentBackends();
  if (std::find(present.begin(), present.end(), GetParam()) == present.end()) {
    GTEST_SKIP() << "this machine has no device for " << GetParam();
  }
  device_ = openDevice(GetParam());
}

void BackendTest::TearDown() {
  closeDevice();
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
