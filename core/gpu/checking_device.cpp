// SPDX-License-Identifier: MIT
#include "core/gpu/checking_device.h"

#include <cstdio>

#include "core/gpu/checking_commands.h"
#include "core/gpu/checking_descriptors.h"

namespace grisaille::gpu {
namespace {

class CheckingDevice final : public Device {
 public:
  CheckingDevice(std::unique_ptr<Device> device, MessageSink message)
      : device_(std::move(device)), message_(std::move(message)), commands_(account_) {
    account_.capabilities = device_->info().capabilities;
  }
  ~CheckingDevice() override {
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

  Commands& begin() override {
    requireIdle("begin()");
    commands_.wrap(device_->begin());
    account_.beginFrame();
    return commands_;
  }
  void submit() override {
    if (!account_.recording) throw Error(ErrorId::kNotRecording, "submit() without begin()");
    if (account_.inPass) {
      throw Error(ErrorId::kPassNesting, "submit() inside pass '{}'", account_.pass);
    }
    try {
      device_->submit();
    } catch (...) {
      abandon();
      throw;
    }
    account_.endFrame(false);
  }
  void abandon() override {
    device_->abandon();
    if (account_.recording) account_.endFrame(true);
  }
  void wait() override { device_->wait(); }

  std::vector<std::byte> read(Texture handle, uint32_t mip, uint32_t layer) override;
  std::vector<std::byte> read(BufferRange range) override;
  bool present(Texture handle) override;
  std::vector<FrameTimes> takeTimes() override { return device_->takeTimes(); }

 private:
  void requireIdle(const char* what) const {
    if (!account_.recording) return;
    throw Error(ErrorId::kAlreadyRecording, "{} while frame {} is being recorded", what,
                account_.frame);
  }

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

  std::unique_ptr<Device> device_;
  MessageSink message_;
  Account account_;
  CheckingCommands commands_;
};

std::vector<std::byte> CheckingDevice::read(Texture handle, uint32_t mip, uint32_t layer) {
  const TextureRecord& texture = account_.usable(handle);
  requireIdle("read()");
  const TextureDesc& desc = texture.desc;
  if (mip >= desc.mips || layer >= desc.layers) {
    throw Error(ErrorId::kReadbackRange,
                "read() of level {}, layer {} of texture '{}', which has {} levels, {} layers", mip,
                layer, texture.label, desc.mips, desc.layers);
  }
  if (!texture.written[size_t{layer} * desc.mips + mip]) {
    throw Error(ErrorId::kUninitialised,
                "level {} of layer {} of texture '{}' is read back but was never written", mip,
                layer, texture.label);
  }
  return device_->read(handle, mip, layer);
}

std::vector<std::byte> CheckingDevice::read(BufferRange range) {
  const BufferRecord& buffer = account_.buffers.get(range.buffer);
  requireIdle("read()");
  if (range.offset >= buffer.size || range.size > buffer.size - range.offset) {
    throw Error(ErrorId::kReadbackRange,
                "read() at offset {}, size {}, of buffer '{}', which has {} bytes", range.offset,
                range.size, buffer.label, buffer.size);
  }
  if (!buffer.written) {
    throw Error(ErrorId::kUninitialised, "buffer '{}' is read back but was never written",
                buffer.label);
  }
  return device_->read(range);
}

bool CheckingDevice::present(Texture handle) {
  requireIdle("present()");
  const TextureRecord& texture = account_.usable(handle);
  if (texture.desc.format != Format::kRgba8Unorm) {
    throw Error(ErrorId::kTextureFormat, "texture '{}' has format {}; present() takes only {}",
                texture.label, formatInfo(texture.desc.format).name,
                formatInfo(Format::kRgba8Unorm).name);
  }
  if (!texture.written[0]) {
    throw Error(ErrorId::kUninitialised, "texture '{}' is presented but was never written",
                texture.label);
  }
  return device_->present(handle);
}

}  // namespace

std::unique_ptr<Device> makeCheckingDevice(std::unique_ptr<Device> device, MessageSink message) {
  return std::make_unique<CheckingDevice>(std::move(device), std::move(message));
}

}  // namespace grisaille::gpu
