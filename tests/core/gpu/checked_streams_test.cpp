// SPDX-License-Identifier: MIT
// Random valid command streams: the checking device must pass every command on.
#include <random>

#include "tests/core/gpu/checked_null.h"

namespace grisaille::tests {
namespace {

class CheckedStreams : public CheckedNull {
 protected:
  struct KnownBuffer {
    gpu::Buffer handle;
    bool written = false, usedNow = false;
  };
  struct KnownTexture {
    gpu::Texture handle;
    uint32_t mips = 1;
    std::vector<bool> written;
    bool usedNow = false, transient = false;
  };
  static constexpr uint64_t kBytes = 1024;
  static constexpr uint32_t kSize = 16;

  uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
  template <typename Known>
  Known& any(std::vector<Known>& list) {
    return list[below(static_cast<uint32_t>(list.size()))];
  }

  void add() {
    if (below(2) == 0) {
      buffers_.push_back({.handle = buffer(kBytes, BufferUsage::kStorage, false)});
      return;
    }
    const uint32_t mips = 1 + below(5);
    textures_.push_back({.handle = device_->createTexture(descOf(mips)),
                         .mips = mips,
                         .written = std::vector<bool>(mips)});
  }
  static gpu::TextureDesc descOf(uint32_t mips) {
    return {.label = "random",
            .format = Format::kR32Float,
            .width = kSize,
            .height = kSize,
            .mips = mips,
            .usage = TextureUsage::kSampled | TextureUsage::kStorage | TextureUsage::kTarget};
  }
  void remove() {
    const size_t at = below(static_cast<uint32_t>(buffers_.size()));
    if (!buffers_[at].usedNow && buffers_.size() > 2) {
      device_->destroy(buffers_[at].handle);
      buffers_.erase(buffers_.begin() + static_cast<ptrdiff_t>(at));
    }
  }
  void upload(gpu::Commands& commands) {
    const std::vector<std::byte> bytes(kBytes);
    if (below(2) == 0) {
      KnownBuffer& known = any(buffers_);
      const uint32_t offset = below(kBytes);
      commands.upload(known.handle, offset, std::span(bytes).first(1 + below(kBytes - offset)));
      known.written = known.usedNow = true;
    } else {
      KnownTexture& known = any(textures_);
      const uint32_t mip = below(known.mips), side = kSize >> mip;
      commands.upload(known.handle, mip, 0, std::span(bytes).first(side * side * 4));
      known.written[mip] = known.usedNow = true;
    }
  }
  void dispatchBuffers(gpu::Commands& commands) {
    KnownBuffer &from = any(buffers_), &to = any(buffers_);
    if (&from == &to || !from.written) {
      if (!to.written) return;
      const gpu::Binding bindings[] = {gpu::storageBinding(0, {to.handle, 256 * below(4)})};
      commands.dispatch({.pipeline = step_, .bindings = bindings});
      to.usedNow = true;
      return;
    }
    const std::vector<std::byte> block(32 + below(100));
    const gpu::Binding bindings[] = {gpu::uniformBinding(0, commands.uniform(block)),
                                     gpu::storageBinding(0, {from.handle}),
                                     gpu::storageBinding(1, {to.handle, 256, 16})};
    commands.dispatch({.pipeline = copy_, .bindings = bindings, .groups = {1 + below(9), 1, 1}});
    from.usedNow = to.usedNow = to.written = true;
  }
  void dispatchTextures(gpu::Commands& commands) {
    KnownTexture &from = any(textures_), &to = any(textures_);
    const uint32_t mip = below(from.mips), toMip = below(to.mips);
    if (!from.written[mip] || (&from == &to && mip == toMip)) {
      if (!to.written[toMip]) return;
      const gpu::Binding bindings[] = {gpu::imageBinding(0, to.handle, toMip)};
      commands.dispatch({.pipeline = imageStep_, .bindings = bindings});
      to.usedNow = true;
      return;
    }
    const gpu::Binding bindings[] = {
        gpu::textureBinding(0, {.texture = from.handle, .mip = mip, .mipCount = 1}, sampler_),
        gpu::imageBinding(0, to.handle, toMip)};
    commands.dispatch({.pipeline = filter_, .bindings = bindings});
    from.usedNow = to.usedNow = to.written[toMip] = true;
  }
  void clear(gpu::Commands& commands) {
    KnownTexture& known = any(textures_);
    const uint32_t mip = below(known.mips);
    const auto load = known.written[mip] ? static_cast<gpu::Load>(below(3)) : gpu::Load::kClear;
    const gpu::ColorTarget colors[] = {
        {.view = {.texture = known.handle, .mip = mip}, .load = load}};
    commands.render({.colors = colors});
    known.written[mip] = known.usedNow = true;
  }
  void frame() {
    const auto buffersBefore = buffers_;
    const auto texturesBefore = textures_;
    gpu::Commands& commands = device_->begin();
    const bool drop = below(5) == 0;
    for (uint32_t passes = below(5); passes > 0; --passes) {
      commands.beginPass("random");
      for (uint32_t calls = below(8); calls > 0; --calls) {
        switch (below(6)) {
          case 0:
            upload(commands);
            break;
          case 1:
            clear(commands);
            break;
          case 2:
            dispatchBuffers(commands);
            break;
          case 3: {
            const uint32_t mips = 1 + below(2);
            textures_.push_back({.handle = commands.transient(descOf(mips)),
                                 .mips = mips,
                                 .written = std::vector<bool>(mips),
                                 .transient = true});
            break;
          }
          default:
            dispatchTextures(commands);
        }
        // Creating and destroying resources does not disturb the frame. Dropping a frame restores
        // the bookkeeping from before it, which must not have changed meanwhile.
        if (!drop && below(8) == 0) remove();
        if (!drop && below(8) == 0) add();
      }
      commands.endPass();
    }
    if (drop) {
      device_->abandon();
      buffers_ = buffersBefore;
      textures_ = texturesBefore;
    } else {
      device_->submit();
    }
    std::erase_if(textures_, [](const KnownTexture& known) { return known.transient; });
    for (KnownBuffer& known : buffers_) known.usedNow = false;
    for (KnownTexture& known : textures_) known.usedNow = false;
  }

  std::mt19937 random_{4711};
  std::vector<KnownBuffer> buffers_;
  std::vector<KnownTexture> textures_;
  const gpu::ComputePipeline copy_ = compute(kCopy), step_ = compute(kStep),
                             filter_ = compute(kFilter), imageStep_ = compute(kImageStep);
  const gpu::Sampler sampler_ = device_->createSampler({});
};

TEST_F(CheckedStreams, ValidOnesNeverRaise) {
  for (int i = 0; i < 40; ++i) add();
  ASSERT_GE(buffers_.size(), 2u);
  ASSERT_GE(textures_.size(), 2u);
  for (int i = 0; i < 3000; ++i) {
    ASSERT_NO_THROW(frame()) << "frame " << i;
    const KnownBuffer& known = any(buffers_);
    const KnownTexture& texels = any(textures_);
    ASSERT_NO_THROW({
      if (known.written) (void)device_->read(gpu::BufferRange{known.handle});
      if (texels.written[0]) (void)device_->read(texels.handle);
    });
  }
  for (const KnownBuffer& known : buffers_) device_->destroy(known.handle);
  for (const KnownTexture& known : textures_) device_->destroy(known.handle);
  for (const gpu::ComputePipeline pipeline : {copy_, step_, filter_, imageStep_}) {
    device_->destroy(pipeline);
  }
  device_->destroy(sampler_);
  device_.reset();
  EXPECT_TRUE(messages_.empty());
}

}  // namespace
}  // namespace grisaille::tests
