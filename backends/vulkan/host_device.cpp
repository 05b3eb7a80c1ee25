// SPDX-License-Identifier: MIT
// A device inside another program, which owns the VkDevice and the queues. This class records
// commands; the program submits them and waits for them.
#include <algorithm>
#include <memory>
#include <optional>

#include "backends/vulkan/barriers.h"
#include "backends/vulkan/foreign_formats.h"
#include "backends/vulkan/making.h"
#include "backends/vulkan/vulkan.h"

namespace grisaille::vulkan {
namespace {

using gpu::Access;

class VulkanHostDevice final : public Making<gpu::HostDevice> {
 public:
  explicit VulkanHostDevice(const HostHandles& handles)
      : Making(handles, CacheFile::kNone, reinterpret_cast<VkPipelineCache>(handles.pipelineCache)),
        recorder_(context_, resources_, {}) {
    for (uint32_t i = 0; i < handles.framesInFlight; ++i) {
      recordings_.push_back(std::make_unique<Recording>(context_, resources_, gpu::Clock::kNone));
    }
  }

  // With its view, so that the first recording that uses a texture creates nothing.
  gpu::Texture createTexture(const gpu::TextureDesc& desc) override {
    const gpu::Texture texture = Making::createTexture(desc);
    if (desc.layers <= 1) native(texture);
    return texture;
  }
  gpu::Texture wrap(const gpu::ForeignTexture& texture) override;
  gpu::ForeignInfo foreign(gpu::Texture texture) override;
  gpu::Commands& begin(void* commandBuffer, uint64_t frame, std::span<const gpu::Texture> reads,
                       std::string_view label) override;
  void end(std::span<const gpu::Texture> writes) override;
  void forget(gpu::Texture texture) override;
  gpu::MemoryUse memory() const override { return context_.memory.use(); }
  uint64_t bytesOf(const gpu::TextureDesc& desc) const override { return resources_.bytesOf(desc); }
  uint64_t bytesOf(const gpu::BufferDesc& desc) const override { return resources_.bytesOf(desc); }
  gpu::NativeTexture native(gpu::Texture texture) override;
  void requireUsable() const override {}

 private:
  uint64_t lastUse() const override { return frame_ ? *frame_ + 1 : 0; }
  uint64_t finished() const override {
    return lastUse() > recordings_.size() ? lastUse() - recordings_.size() : 0;
  }
  void turnTo(uint64_t frame);
  void hand(bool toUs);
  void addForeign(const TextureObject& object);

  std::vector<std::unique_ptr<Recording>> recordings_;  // one per frame in flight
  Recorder recorder_;
  std::optional<uint64_t> frame_;  // number of the last frame
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  std::vector<VkImageMemoryBarrier2> foreign_;  // for the program's textures that are read
};

gpu::Texture VulkanHostDevice::wrap(const gpu::ForeignTexture& texture) {
  return resources_.addForeign(makeForeign(context_, texture));
}

gpu::ForeignInfo VulkanHostDevice::foreign(gpu::Texture texture) {
  const TextureObject& object = resources_.get(texture);
  const ForeignFormat& format = foreignFormat(object.format);
  return {.width = object.desc.width,
          .height = object.desc.height,
          .layers = object.desc.layers,
          .channels = format.channels,
          .depth = format.depth(),
          .format = fmt::format("{} ({})", format.name, static_cast<int>(format.format))};
}

// Starts a frame: reuses the memory of the frame recordings_.size() before, which has finished.
void VulkanHostDevice::turnTo(uint64_t frame) {
  if (frame_ && frame < *frame_) {
    throw Error(ErrorId::kHostFrame, "frame {} follows frame {}; numbers must not fall", frame,
                *frame_);
  }
  if (frame_ == frame) return;
  recorder_.endFrame(lastUse());
  frame_ = frame;
  recordings_[frame % recordings_.size()]->reset();
  resources_.releaseUpTo(finished());
}

// Records the barriers before (`toUs`) and after the layer's commands. They change the program's
// textures between its layouts and the layout for sampling. They cover all memory and stages, so
// that the program need not know which stages the layer uses.
void VulkanHostDevice::hand(bool toUs) {
  VkMemoryBarrier2 all{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  all.srcStageMask = all.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  all.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  all.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  if (!toUs) {
    for (VkImageMemoryBarrier2& barrier : foreign_) std::swap(barrier.oldLayout, barrier.newLayout);
  }
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &all;
  info.imageMemoryBarrierCount = static_cast<uint32_t>(foreign_.size());
  info.pImageMemoryBarriers = foreign_.data();
  context_.vk.vkCmdPipelineBarrier2(commands_, &info);
}

// Wrappers of one image may share layers: each layer gets one barrier.
void VulkanHostDevice::addForeign(const TextureObject& object) {
  const VkImageAspectFlags aspects = aspectsIn(object.home, foreignFormat(object.format));
  for (uint32_t i = 0; i < object.desc.layers; ++i) {
    const uint32_t layer = object.firstLayer + i;
    const bool twin = std::ranges::any_of(foreign_, [&](const VkImageMemoryBarrier2& other) {
      return other.image == object.image && other.subresourceRange.baseArrayLayer == layer;
    });
    if (twin) continue;
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = object.home;
    barrier.newLayout = layoutOf(Access::kSampled);
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = object.image;
    barrier.subresourceRange = {aspects, 0, 1, layer, 1};
    foreign_.push_back(barrier);
  }
}

gpu::Commands& VulkanHostDevice::begin(void* commandBuffer, uint64_t frame,
                                       std::span<const gpu::Texture> reads,
                                       std::string_view label) {
  if (commandBuffer == nullptr) throw Error(ErrorId::kHostFrame, "the command buffer is null");
  turnTo(frame);
  commands_ = static_cast<VkCommandBuffer>(commandBuffer);
  foreign_.clear();
  for (const gpu::Texture texture : reads) addForeign(resources_.get(texture));
  hand(true);
  recorder_.begin(*recordings_[frame % recordings_.size()], commands_, label);
  return recorder_;
}

void VulkanHostDevice::end(std::span<const gpu::Texture> writes) {
  for (const gpu::Texture texture : writes) {
    resources_.tracker().use(gpu::TextureView{.texture = texture}, Access::kSampled);
  }
  resources_.recordBarriers(commands_);
  hand(false);
  recorder_.end();
  // The frames that follow allocate nothing, whichever recording they take.
  const Recording& own = *recordings_[*frame_ % recordings_.size()];
  for (const auto& recording : recordings_) recording->prepareLike(own);
}

void VulkanHostDevice::forget(gpu::Texture texture) {
  const gpu::TextureDesc& desc = resources_.get(texture).desc;
  resources_.tracker().add(texture, std::max(desc.mips, 1u), std::max(desc.layers, 1u));
}

gpu::NativeTexture VulkanHostDevice::native(gpu::Texture texture) {
  const gpu::TextureView whole = resources_.resolve(gpu::TextureView{.texture = texture});
  const TextureObject& object = resources_.get(texture);
  const VkImageView view = resources_.viewOf(
      whole, object.desc.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D);
  return {.name = reinterpret_cast<uint64_t>(object.image),
          .view = reinterpret_cast<uint64_t>(view),
          .format = static_cast<uint32_t>(object.format),
          .layout = static_cast<uint32_t>(layoutOf(Access::kSampled))};
}

}  // namespace

std::unique_ptr<gpu::HostDevice> createHostDevice(const HostHandles& handles) {
  return std::make_unique<VulkanHostDevice>(handles);
}

}  // namespace grisaille::vulkan
