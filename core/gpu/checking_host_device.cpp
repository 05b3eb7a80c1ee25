// SPDX-License-Identifier: MIT
#include "core/gpu/checking_device.h"
#include "core/gpu/checking_maker.h"

namespace grisaille::gpu {
namespace {

class CheckingHostDevice final : public CheckingMaker<HostDevice> {
 public:
  using CheckingMaker::CheckingMaker;

  Texture wrap(const ForeignTexture& foreign) override {
    const Texture texture = device_->wrap(foreign);
    const ForeignInfo info = device_->foreign(texture);
    // As shaders see it. The program has written it.
    account_.textures.add(texture, {.label = fmt::format("the program's texture {}", foreign.name),
                                    .desc = {.format = Format::kRgba32Float,
                                             .width = info.width,
                                             .height = info.height,
                                             .layers = info.layers,
                                             .usage = TextureUsage::kSampled},
                                    .written = std::vector<bool>(info.layers, true)});
    return texture;
  }
  ForeignInfo foreign(Texture texture) override {
    account_.textures.get(texture);
    return device_->foreign(texture);
  }

  Commands& begin(void* commandBuffer, uint64_t frame, std::span<const Texture> reads,
                  std::string_view label) override {
    if (account_.recording) {
      throw Error(ErrorId::kAlreadyRecording, "begin() while recording {} is open", account_.frame);
    }
    for (const Texture texture : reads) account_.usable(texture);
    commands_.wrap(device_->begin(commandBuffer, frame, reads, label));
    account_.beginFrame();
    return commands_;
  }
  // After a recording that threw, the pass that it began is still open: the device closes it.
  void end(std::span<const Texture> writes) override {
    for (const Texture texture : writes) account_.usable(texture);
    device_->end(writes);
    account_.inPass = false;
    account_.endFrame(false);
  }
  void forget(Texture handle) override {
    TextureRecord& texture = account_.usable(handle);
    texture.written.assign(texture.written.size(), false);
    device_->forget(handle);
  }

  MemoryUse memory() const override { return device_->memory(); }
  uint64_t bytesOf(const TextureDesc& desc) const override { return device_->bytesOf(desc); }
  uint64_t bytesOf(const BufferDesc& desc) const override { return device_->bytesOf(desc); }
  NativeTexture native(Texture texture) override {
    account_.usable(texture);
    return device_->native(texture);
  }
  void requireUsable() const override { device_->requireUsable(); }
};

}  // namespace

std::unique_ptr<HostDevice> makeCheckingHostDevice(std::unique_ptr<HostDevice> device,
                                                   MessageSink message) {
  return std::make_unique<CheckingHostDevice>(std::move(device), std::move(message));
}

}  // namespace grisaille::gpu
