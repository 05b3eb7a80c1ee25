// SPDX-License-Identifier: MIT
#include "backends/vulkan/resources.h"

#include "backends/vulkan/barriers.h"

namespace grisaille::vulkan {
namespace {

VkBufferUsageFlags usageOf(gpu::BufferUsage usage) {
  VkBufferUsageFlags flags = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (has(usage, gpu::BufferUsage::kVertex)) flags |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
  if (has(usage, gpu::BufferUsage::kIndex)) flags |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
  if (has(usage, gpu::BufferUsage::kUniform)) flags |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
  if (has(usage, gpu::BufferUsage::kStorage)) flags |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  return flags;
}

}  // namespace

Resources::~Resources() {
  const auto releaseAll = [this](auto& pool) {
    pool.forEach([this](auto, auto& object) { release(context_, object); });
  };
  releaseUpTo(UINT64_MAX);
  releaseAll(buffers_);
  releaseAll(textures_);
  releaseAll(samplers_);
  releaseAll(computes_);
  releaseAll(graphics_);
}

template <typename Pool, typename Made>
auto Resources::own(Pool& pool, Made object) {
  try {
    return pool.add(object);
  } catch (...) {
    release(context_, object);
    throw;
  }
}

gpu::Buffer Resources::add(const gpu::BufferDesc& desc) {
  const gpu::Buffer buffer =
      addUntracked(desc.label, desc.size, usageOf(desc.usage), MemoryKind::kDevice);
  tracker_.add(buffer);
  committed_.add(buffer);
  return buffer;
}

gpu::Buffer Resources::addUntracked(std::string_view label, uint64_t size, VkBufferUsageFlags usage,
                                    MemoryKind kind) {
  return own(buffers_, makeBuffer(context_, label, size, usage, kind));
}

gpu::Texture Resources::add(const gpu::TextureDesc& desc) {
  const gpu::Texture texture = own(textures_, makeTexture(context_, desc));
  tracker_.add(texture, desc.mips, desc.layers);
  committed_.add(texture, desc.mips, desc.layers);
  return texture;
}

gpu::Texture Resources::addForeign(const TextureObject& object) {
  return own(textures_, object);
}

gpu::Sampler Resources::add(const gpu::SamplerDesc& desc) {
  return own(samplers_, makeSampler(context_, desc));
}

gpu::ComputePipeline Resources::add(VkPipelineCache cache, const gpu::ComputePipelineDesc& desc) {
  return own(computes_, makePipeline(context_, cache, desc));
}

gpu::GraphicsPipeline Resources::add(VkPipelineCache cache, const gpu::GraphicsPipelineDesc& desc) {
  return own(graphics_, makePipeline(context_, cache, desc));
}

void Resources::retire(gpu::Buffer buffer, uint64_t count) {
  retired_.emplace_back(count, buffers_.remove(buffer));
  tracker_.remove(buffer);
  committed_.remove(buffer);
}

void Resources::retire(gpu::Texture texture, uint64_t count) {
  retired_.emplace_back(count, textures_.remove(texture));
  tracker_.remove(texture);
  committed_.remove(texture);
}

void Resources::retire(gpu::Sampler sampler, uint64_t count) {
  retired_.emplace_back(count, samplers_.remove(sampler));
}

void Resources::retire(gpu::ComputePipeline pipeline, uint64_t count) {
  retired_.emplace_back(count, computes_.remove(pipeline));
}

void Resources::retire(gpu::GraphicsPipeline pipeline, uint64_t count) {
  retired_.emplace_back(count, graphics_.remove(pipeline));
}

void Resources::releaseUpTo(uint64_t completed) {
  while (!retired_.empty() && retired_.front().first <= completed) {
    std::visit([this](auto& object) { release(context_, object); }, retired_.front().second);
    retired_.pop_front();
  }
}

gpu::TextureView Resources::resolve(gpu::TextureView view) {
  const gpu::TextureDesc& desc = textures_.get(view.texture).desc;
  const bool starts = view.mip < desc.mips && view.layer < desc.layers;
  if (starts && view.mipCount == 0) view.mipCount = desc.mips - view.mip;
  if (starts && view.layerCount == 0) view.layerCount = desc.layers - view.layer;
  if (!starts || view.mipCount > desc.mips - view.mip ||
      view.layerCount > desc.layers - view.layer) {
    throw Error(ErrorId::kBindingRange,
                "mips {} + {} and layers {} + {} exceed a texture of {} mips and {} layers",
                view.mip, view.mipCount, view.layer, view.layerCount, desc.mips, desc.layers);
  }
  return view;
}

gpu::BufferRange Resources::resolve(gpu::BufferRange range) {
  const uint64_t size = buffers_.get(range.buffer).size;
  const bool starts = range.offset < size;
  if (starts && range.size == 0) range.size = size - range.offset;
  if (!starts || range.size > size - range.offset) {
    throw Error(ErrorId::kBindingRange, "bytes {} + {} exceed a buffer of {} bytes", range.offset,
                range.size, size);
  }
  return range;
}

uint64_t Resources::bytesOf(const gpu::TextureDesc& desc) const {
  return textureBytes(context_, desc);
}

uint64_t Resources::bytesOf(const gpu::BufferDesc& desc) const {
  return bufferBytes(context_, desc.size, usageOf(desc.usage));
}

VkImageView Resources::viewOf(const gpu::TextureView& view, VkImageViewType type) {
  return vulkan::viewOf(context_, textures_.get(view.texture), view, type);
}

void Resources::recordBarriers(VkCommandBuffer commands) {
  bufferBarriers_.clear();
  imageBarriers_.clear();
  for (const gpu::Transition& transition : tracker_.flush()) {
    if (transition.buffer) {
      bufferBarriers_.push_back(bufferBarrier(transition, buffers_.get(transition.buffer).buffer));
    } else {
      const TextureObject& texture = textures_.get(transition.texture);
      imageBarriers_.push_back(
          imageBarrier(transition, texture.image, aspectOf(texture.desc.format)));
    }
  }
  if (bufferBarriers_.empty() && imageBarriers_.empty()) return;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.bufferMemoryBarrierCount = static_cast<uint32_t>(bufferBarriers_.size());
  info.pBufferMemoryBarriers = bufferBarriers_.data();
  info.imageMemoryBarrierCount = static_cast<uint32_t>(imageBarriers_.size());
  info.pImageMemoryBarriers = imageBarriers_.data();
  context_.vk.vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace grisaille::vulkan
