// SPDX-License-Identifier: MIT
#include "core/gpu/checking_device.h"

#include "core/gpu/checking_maker.h"

namespace grisaille::gpu {
namespace {

class CheckingDevice final : public CheckingMaker<Device> {
 public:
  using CheckingMaker::CheckingMaker;

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
