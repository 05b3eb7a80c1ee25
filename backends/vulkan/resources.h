// SPDX-License-Identifier: MIT
// Everything that the layer's handles name, the states of it, and what waits to be released.
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
  ~Resources();  // releases all; the device is idle
  Resources(const Resources&) = delete;
  Resources& operator=(const Resources&) = delete;

  gpu::Buffer add(const gpu::BufferDesc& desc);
  gpu::Texture add(const gpu::TextureDesc& desc);
  // Another program's, whose hazards are its own.
  gpu::Texture addForeign(const TextureObject& object);
  gpu::Sampler add(const gpu::SamplerDesc& desc);
  gpu::ComputePipeline add(VkPipelineCache cache, const gpu::ComputePipelineDesc& desc);
  gpu::GraphicsPipeline add(VkPipelineCache cache, const gpu::GraphicsPipelineDesc& desc);

  // A buffer whose hazards are not tracked: the layer's own upload memory.
  gpu::Buffer addUntracked(std::string_view label, uint64_t size, VkBufferUsageFlags usage,
                           MemoryKind kind);

  // The handle is stale at once; the object goes when release() is told that the timeline has
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

  // A view with its zero counts replaced. Throws kStaleHandle, kBindingRange.
  gpu::TextureView resolve(gpu::TextureView view);
  // A range with its zero size replaced. Throws kStaleHandle, kBindingRange.
  gpu::BufferRange resolve(gpu::BufferRange range);

  // Of a resolved view.
  VkImageView viewOf(const gpu::TextureView& view, VkImageViewType type);

  // Declare uses to it, then record the barriers that they need.
  gpu::StateTracker& tracker() { return tracker_; }
  void recordBarriers(VkCommandBuffer commands);

  // What is recorded is submitted; or is dropped, and the states are again what they were.
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
