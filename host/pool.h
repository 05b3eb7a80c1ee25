// SPDX-License-Identifier: MIT
// The textures and buffers of one effect: how much memory they take, and those that it does not use
// at present but will when its picture has an earlier size again.
#pragma once

#include <string>
#include <vector>

#include "core/gpu/forwarding_maker.h"
#include "core/gpu/host_device.h"

namespace grisaille::host {

class Pool final : public gpu::ForwardingMaker {
 public:
  // `maker` creates the resources, `sizes` tells their bytes; both must outlive this. `keptSizes`:
  // see grisaille_host_effect_desc.
  Pool(gpu::Maker& maker, const gpu::HostDevice& sizes, uint32_t keptSizes)
      : ForwardingMaker(maker), sizes_(sizes), keptSizes_(keptSizes) {}
  ~Pool() override { clear(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  // Begins and ends a recording of a picture of this size. end() also destroys what several
  // recordings of this size have not used.
  void begin(uint32_t width, uint32_t height);
  void end();

  // A texture until takeBack() or end(). Its contents are undefined.
  gpu::Texture transient(const gpu::TextureDesc& desc);

  // Takes all transient textures back, for another view of the same recording.
  void takeBack();

  // Takes all transient textures back, and destroys all resources that nobody uses.
  void clear();

  // Of all its resources.
  const gpu::MemoryUse& use() const { return use_; }

  gpu::Buffer createBuffer(const gpu::BufferDesc& desc) override;
  gpu::Texture createTexture(const gpu::TextureDesc& desc) override;
  using ForwardingMaker::destroy;
  void destroy(gpu::Buffer buffer) override;
  void destroy(gpu::Texture texture) override;

 private:
  enum class State : uint8_t { kUsed, kTransient, kFree };
  struct Size {
    uint32_t width = 0, height = 0;
    bool operator==(const Size&) const = default;
  };
  // `Handle`: gpu::Texture or gpu::Buffer.
  template <typename Handle, typename Desc>
  struct Entry {
    Handle handle;
    Desc desc;  // its label is `label`
    std::string label;
    uint64_t bytes = 0;
    State state = State::kUsed;
    Size size;          // of the picture that used it last
    uint32_t idle = 0;  // recordings of that size since
  };

  template <typename Entries, typename Desc, typename Create>
  auto take(Entries& entries, const Desc& desc, State state, const Create& create);
  template <typename Entries, typename Handle>
  void giveBack(Entries& entries, Handle handle);
  template <typename Entries>
  void finish(Entries& entries);
  template <typename Entries, typename Condition>
  void release(Entries& entries, const Condition& condition);

  const gpu::HostDevice& sizes_;
  const uint32_t keptSizes_;
  gpu::MemoryUse use_;
  std::vector<Entry<gpu::Texture, gpu::TextureDesc>> textures_;
  std::vector<Entry<gpu::Buffer, gpu::BufferDesc>> buffers_;
  std::vector<Size> recent_;  // sizes whose memory is kept, the latest last
  bool recording_ = false;
};

// Commands that take transient textures from a pool, and count what they upload.
class PooledCommands final : public gpu::Commands {
 public:
  explicit PooledCommands(Pool& pool) : pool_(pool) {}

  // The commands of this recording.
  void wrap(gpu::Commands& commands) {
    commands_ = &commands;
    uploaded_ = 0;
  }
  uint64_t uploaded() const { return uploaded_; }  // bytes since wrap()

  void beginPass(std::string_view label) override { commands_->beginPass(label); }
  void endPass() override { commands_->endPass(); }
  void render(const gpu::Render& render) override { commands_->render(render); }
  void dispatch(const gpu::Dispatch& dispatch) override { commands_->dispatch(dispatch); }
  gpu::BufferRange uniform(std::span<const std::byte> bytes) override {
    uploaded_ += bytes.size();
    return commands_->uniform(bytes);
  }
  gpu::Texture transient(const gpu::TextureDesc& desc) override { return pool_.transient(desc); }
  void upload(gpu::Buffer buffer, uint64_t offset, std::span<const std::byte> bytes) override {
    uploaded_ += bytes.size();
    commands_->upload(buffer, offset, bytes);
  }
  void upload(gpu::Texture texture, uint32_t mip, uint32_t layer,
              std::span<const std::byte> bytes) override {
    uploaded_ += bytes.size();
    commands_->upload(texture, mip, layer, bytes);
  }

 private:
  Pool& pool_;
  gpu::Commands* commands_ = nullptr;
  uint64_t uploaded_ = 0;
};

}  // namespace grisaille::host
