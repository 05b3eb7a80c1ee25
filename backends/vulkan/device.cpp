// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstring>

#include "backends/vulkan/making.h"
#include "backends/vulkan/swapchain.h"
#include "backends/vulkan/vulkan.h"

namespace grisaille::vulkan {
namespace {

constexpr size_t kFramesInFlight = 2;

class VulkanDevice : public Making<gpu::Device> {
 public:
  explicit VulkanDevice(const gpu::DeviceOptions& options)
      : Making(options, CacheFile::kOwn),
        timeline_(context_),
        readback_(context_),
        frames_{Frame(context_, resources_, clockOf(options)),
                Frame(context_, resources_, clockOf(options))},
        recorder_(context_, resources_, [this] { drain(); }) {
    if (context_.surface() != nullptr) swapchain_.emplace(context_, resources_, timeline_);
  }

  // Waits until the device is idle, before anything is released. A lost device counts as idle.
  ~VulkanDevice() override {
    context_.vk.vkDeviceWaitIdle(context_.device);
    release(context_, readbackMemory_);
  }

  gpu::Commands& begin() override;
  void submit() override;
  void abandon() override;
  void wait() override;

  std::vector<std::byte> read(gpu::Texture texture, uint32_t mip, uint32_t layer) override;
  std::vector<std::byte> read(gpu::BufferRange range) override;

  bool present(gpu::Texture texture) override {
    if (swapchain_) return swapchain_->show(texture);
    throw Error(ErrorId::kNoWindow, "Vulkan has no window to show a picture in");
  }

  std::vector<gpu::FrameTimes> takeTimes() override;

 private:
  gpu::Clock clockOf(const gpu::DeviceOptions& options) const {
    return options.timed ? context_.info.clock : gpu::Clock::kNone;
  }

  uint64_t lastUse() const override {
    return timeline_.submitted() + (recorder_.recording() ? 1 : 0);
  }
  uint64_t finished() const override { return timeline_.completed(); }

  Frame& current() { return frames_[(begun_ - 1) % frames_.size()]; }
  void endFrame();
  void drain();
  void collectTimes();
  void reserveReadback(uint64_t bytes);
  template <typename Copy>
  std::vector<std::byte> readBack(uint64_t bytes, Copy&& copy);

  Timeline timeline_;
  CommandBuffer readback_;
  BufferObject readbackMemory_;
  std::array<Frame, kFramesInFlight> frames_;
  Recorder recorder_;
  std::optional<Swapchain> swapchain_;  // none without a window
  uint64_t begun_ = 0;                  // number of frames begun
  std::vector<gpu::FrameTimes> times_;
};

gpu::Commands& VulkanDevice::begin() {
  Frame& frame = frames_[begun_ % frames_.size()];
  timeline_.wait(frame.done);
  collectTimes();
  resources_.releaseUpTo(timeline_.completed());
  frame.recording.reset();
  frame.commands.begin();
  frame.recording.timer.beginFrame(begun_);
  recorder_.begin(frame.recording, frame.commands.handle());
  ++begun_;
  return recorder_;
}

void VulkanDevice::submit() {
  try {
    current().done = current().commands.submit(timeline_);
  } catch (...) {
    abandon();
    throw;
  }
  resources_.commit();
  endFrame();
  resources_.releaseUpTo(timeline_.completed());
}

void VulkanDevice::abandon() {
  if (!recorder_.recording()) return;
  current().recording.timer.drop();
  resources_.rollBack();
  endFrame();
}

void VulkanDevice::endFrame() {
  recorder_.end();
  recorder_.endFrame(timeline_.submitted());
}

void VulkanDevice::drain() {
  Frame& frame = current();
  frame.done = frame.commands.submit(timeline_);
  resources_.commit();
  timeline_.wait(frame.done);
  frame.commands.begin();
}

void VulkanDevice::wait() {
  timeline_.wait(timeline_.submitted());
  resources_.releaseUpTo(timeline_.completed());
}

// Collects the oldest frame first.
void VulkanDevice::collectTimes() {
  const uint64_t completed = timeline_.completed();
  for (size_t i = 0; i < frames_.size(); ++i) {
    Frame& frame = frames_[(begun_ + i) % frames_.size()];
    if (frame.done > completed) continue;
    if (std::optional<gpu::FrameTimes> times = frame.recording.timer.collect()) {
      times_.push_back(std::move(*times));
    }
  }
}

std::vector<gpu::FrameTimes> VulkanDevice::takeTimes() {
  if (!recorder_.recording()) collectTimes();
  return std::exchange(times_, {});
}

void VulkanDevice::reserveReadback(uint64_t bytes) {
  if (readbackMemory_.size >= bytes) return;
  release(context_, readbackMemory_);
  readbackMemory_ = makeBuffer(context_, "readback", bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                               MemoryKind::kReadback);
}

// `copy` declares a use, then records the barriers and a copy to readbackMemory_.
template <typename Copy>
std::vector<std::byte> VulkanDevice::readBack(uint64_t bytes, Copy&& copy) {
  wait();
  reserveReadback(bytes);
  readback_.begin();
  copy(readback_.handle());
  VkMemoryBarrier2 toHost{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  toHost.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  toHost.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  toHost.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  toHost.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &toHost;
  context_.vk.vkCmdPipelineBarrier2(readback_.handle(), &info);
  timeline_.wait(readback_.submit(timeline_));
  resources_.commit();
  return {readbackMemory_.mapped, readbackMemory_.mapped + bytes};
}

std::vector<std::byte> VulkanDevice::read(gpu::Texture texture, uint32_t mip, uint32_t layer) {
  const gpu::TextureView view = resources_.resolve(gpu::TextureView{
      .texture = texture, .mip = mip, .mipCount = 1, .layer = layer, .layerCount = 1});
  const TextureObject& from = resources_.get(texture);
  const VkBufferImageCopy region = copyRegion(from.desc, mip, layer, 0);
  const uint64_t bytes = uint64_t{region.imageExtent.width} * region.imageExtent.height *
                         gpu::formatInfo(from.desc.format).texelBytes;
  return readBack(bytes, [&](VkCommandBuffer commands) {
    resources_.tracker().use(view, gpu::Access::kCopyRead);
    resources_.recordBarriers(commands);
    context_.vk.vkCmdCopyImageToBuffer(commands, from.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                       readbackMemory_.buffer, 1, &region);
  });
}

std::vector<std::byte> VulkanDevice::read(gpu::BufferRange range) {
  range = resources_.resolve(range);
  const VkBuffer from = resources_.get(range.buffer).buffer;
  return readBack(range.size, [&](VkCommandBuffer commands) {
    resources_.tracker().use(range.buffer, gpu::Access::kCopyRead);
    resources_.recordBarriers(commands);
    const VkBufferCopy region{range.offset, 0, range.size};
    context_.vk.vkCmdCopyBuffer(commands, from, readbackMemory_.buffer, 1, &region);
  });
}

}  // namespace

std::vector<gpu::ListedDevice> listDevices() {
  const Instance instance(false, {});
  std::vector<gpu::ListedDevice> list;
  for (const Candidate& candidate : candidates(instance)) list.push_back(candidate.listed);
  return list;
}

std::unique_ptr<gpu::Device> createDevice(const gpu::DeviceOptions& options) {
  return std::make_unique<VulkanDevice>(options);
}

}  // namespace grisaille::vulkan
