// SPDX-License-Identifier: MIT
// The base class of both checking devices: checks the creation and destruction of resources.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/gpu/checking_commands.h"
#include "core/gpu/checking_descriptors.h"

namespace grisaille::gpu {

// `Interface`: Device or HostDevice.
template <typename Interface>
class CheckingMaker : public Interface {
 public:
  CheckingMaker(std::unique_ptr<Interface> device, MessageSink message)
      : device_(std::move(device)), message_(std::move(message)), commands_(account_) {
    account_.capabilities = device_->info().capabilities;
  }
  ~CheckingMaker() override {
    reportLeaks(account_.buffers);
    reportLeaks(account_.textures);
    reportLeaks(account_.samplers);
    reportLeaks(account_.computePipelines);
    reportLeaks(account_.graphicsPipelines);
  }

  const DeviceInfo& info() const override { return device_->info(); }

  Buffer createBuffer(const BufferDesc& desc) override {
    checkDescriptor(desc, account_.capabilities);
    const Buffer buffer = device_->createBuffer(desc);
    account_.buffers.add(
        buffer, {.label = std::string(desc.label), .size = desc.size, .usage = desc.usage});
    return buffer;
  }
  Texture createTexture(const TextureDesc& desc) override {
    checkDescriptor(desc, account_.capabilities);
    const Texture texture = device_->createTexture(desc);
    TextureRecord record{.label = std::string(desc.label),
                         .desc = desc,
                         .written = std::vector<bool>(size_t{desc.mips} * desc.layers)};
    record.desc.label = {};
    account_.textures.add(texture, std::move(record));
    return texture;
  }
  Sampler createSampler(const SamplerDesc& desc) override {
    const Sampler sampler = device_->createSampler(desc);
    account_.samplers.add(sampler, {.label = std::string(desc.label), .filter = desc.filter});
    return sampler;
  }
  ComputePipeline createComputePipeline(const ComputePipelineDesc& desc) override {
    checkDescriptor(desc);
    const ComputePipeline pipeline = device_->createComputePipeline(desc);
    account_.computePipelines.add(pipeline,
                                  {.label = std::string(desc.label), .shaders = {desc.shader}});
    return pipeline;
  }
  GraphicsPipeline createGraphicsPipeline(const GraphicsPipelineDesc& desc) override {
    checkDescriptor(desc);
    const GraphicsPipeline pipeline = device_->createGraphicsPipeline(desc);
    PipelineRecord record{.label = std::string(desc.label),
                          .shaders = {desc.vertex},
                          .streamStrides = {desc.streamStrides.begin(), desc.streamStrides.end()},
                          .attributes = {desc.attributes.begin(), desc.attributes.end()},
                          .colorFormats = {desc.colorFormats.begin(), desc.colorFormats.end()},
                          .depthFormat = desc.depthFormat};
    if (desc.fragment != nullptr) record.shaders.push_back(desc.fragment);
    account_.graphicsPipelines.add(pipeline, std::move(record));
    return pipeline;
  }

  void destroy(Buffer buffer) override { destroyIn(account_.buffers, buffer); }
  void destroy(Texture texture) override {
    const TextureRecord* record = account_.textures.find(texture);
    if (record != nullptr && record->transient) {
      throw Error(ErrorId::kTransientStale,
                  "transient texture '{}' cannot be destroyed: submit() ends it", record->label);
    }
    destroyIn(account_.textures, texture);
  }
  void destroy(Sampler sampler) override { destroyIn(account_.samplers, sampler); }
  void destroy(ComputePipeline pipeline) override {
    destroyIn(account_.computePipelines, pipeline);
  }
  void destroy(GraphicsPipeline pipeline) override {
    destroyIn(account_.graphicsPipelines, pipeline);
  }

 private:
  template <typename HandleType, typename Record>
  void destroyIn(Records<HandleType, Record>& records, HandleType handle) {
    if (!handle) return;
    const Record& record = records.get(handle);
    if (account_.recording && record.usedFrame == account_.frame) {
      throw Error(ErrorId::kDestroyedInUse, "{} '{}' is used by the frame being recorded",
                  records.kind(), record.label);
    }
    device_->destroy(handle);
    records.remove(handle);
  }

  template <typename HandleType, typename Record>
  void reportLeaks(Records<HandleType, Record>& records) {
    for (const auto& entry : records.all()) {
      const Record& record = entry.second;
      if constexpr (requires { record.transient; }) {
        if (record.transient) continue;
      }
      const Error error(ErrorId::kLeaked, "{} '{}' was not destroyed", records.kind(),
                        record.label);
      if (message_) {
        message_(Severity::kError, error.what());
      } else {
        fmt::print(stderr, "{}\n", error.what());
      }
    }
  }

 protected:
  std::unique_ptr<Interface> device_;
  MessageSink message_;
  Account account_;
  CheckingCommands commands_;
};

}  // namespace grisaille::gpu
