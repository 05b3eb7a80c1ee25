// SPDX-License-Identifier: MIT
// The objects behind the layer's handles, their states, and the queue of objects to release.
#pragma once

#include <deque>
#include <utility>
#include <variant>

#include "backends/vulkan/objects.h"
#include "backends/vulkan/pipelines.h"
#include "core/gpu/handle_pool.h"
#include "core/gpu/state_tracker.h"

namespace grisaille::vulkan {

class Resources {
 public:
  explicit Resources(Context& context) : context_(context) {}
  ~Resources();  // releases all objects; the device must be idle
  Resources(const Resources&) = delete;
  Resources& operator=(const Resources&) = delete;

  gpu::Buffer add(const gpu::BufferDesc& desc);
  gpu::Texture add(const gpu::TextureDesc& desc);
  // Adds another program's texture. The layer does not track its hazards.
  gpu::Texture addForeign(const TextureObject& object);
  gpu::Sampler add(const gpu::SamplerDesc& desc);
  gpu::ComputePipeline add(VkPipelineCache cache, const gpu::ComputePipelineDesc& desc);
  gpu::GraphicsPipeline add(VkPipelineCache cache, const gpu::GraphicsPipelineDesc& desc);

  // Adds a buffer without hazard tracking: for the layer's own upload memory.
  gpu::Buffer addUntracked(std::string_view label, uint64_t size, VkBufferUsageFlags usage,
                           MemoryKind kind);

  // The handle becomes stale at once. releaseUpTo() releases the object when the timeline has
  // reached `count`.
  void retire(gpu::Buffer buffer, uint64_t count);
  void retire(gpu::Texture texture, uint64_t count);
  void retire(gpu::Sampler sampler, uint64_t count);
  void retire(gpu::ComputePipeline pipeline, uint64_t count);
  void retire(gpu::GraphicsPipeline pipeline, uint64_t count);
  void releaseUpTo(uint64_t completed);

  BufferObject& get(gpu::Buffer buffer) { return buffers_.get(buffer); }
  TextureObject& get(gpu::Texture texture) { return textures_.get(texture); }
  VkSampler get(gpu::Sampler sampler) { return samplers_.get(sampler).sampler; }
  const PipelineObject& get(gpu::ComputePipeline pipeline) { return computes_.get(pipeline); }
  const PipelineObject& get(gpu::GraphicsPipeline pipeline) { return graphics_.get(pipeline); }

  // Replaces the view's zero counts by all remaining mips or layers. Throws kStaleHandle,
  // kBindingRange.
  gpu::TextureView resolve(gpu::TextureView view);
  // Replaces the range's zero size by all remaining bytes. Throws kStaleHandle, kBindingRange.
  gpu::BufferRange resolve(gpu::BufferRange range);

  uint64_t bytesOf(const gpu::TextureDesc& desc) const;
  uint64_t bytesOf(const gpu::BufferDesc& desc) const;

  // `view` must be resolved.
  VkImageView viewOf(const gpu::TextureView& view, VkImageViewType type);

  // Declare uses to the tracker, then call recordBarriers() for the barriers that they need.
  gpu::StateTracker& tracker() { return tracker_; }
  void recordBarriers(VkCommandBuffer commands);

  // Call commit() when the recorded commands are submitted; rollBack() when they are dropped, to
  // restore the states of the last submission.
  void commit() { committed_ = tracker_; }
  void rollBack() { tracker_ = committed_; }

 private:
  using Object = std::variant<BufferObject, TextureObject, SamplerObject, PipelineObject>;

  template <typename Pool, typename Made>
  auto own(Pool& pool, Made object);

  Context& context_;
  gpu::HandlePool<gpu::Buffer, BufferObject> buffers_{"buffer"};
  gpu::HandlePool<gpu::Texture, TextureObject> textures_{"texture"};
  gpu::HandlePool<gpu::Sampler, SamplerObject> samplers_{"sampler"};
  gpu::HandlePool<gpu::ComputePipeline, PipelineObject> computes_{"compute pipeline"};
  gpu::HandlePool<gpu::GraphicsPipeline, PipelineObject> graphics_{"graphics pipeline"};
  std::deque<std::pair<uint64_t, Object>> retired_;
  gpu::StateTracker tracker_;
  gpu::StateTracker committed_;  // as of the last submission
  std::vector<VkBufferMemoryBarrier2> bufferBarriers_;
  std::vector<VkImageMemoryBarrier2> imageBarriers_;
};

}  // namespace grisaille::vulkan
