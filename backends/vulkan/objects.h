// SPDX-License-Identifier: MIT
// Vulkan objects behind the layer's handles, made and released as wholes. What is not made yet is
// null, and releasing null does nothing.
#pragma once

#include <cstddef>
#include <vector>

#include "backends/vulkan/context.h"

namespace grisaille::vulkan {

struct BufferObject {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  uint64_t size = 0;            // bytes
  std::byte* mapped = nullptr;  // null for MemoryKind::kDevice
};

struct TextureObject {
  struct View {
    gpu::TextureView range;
    VkImageViewType type = VK_IMAGE_VIEW_TYPE_2D;
    VkImageView view = VK_NULL_HANDLE;
  };

  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageAspectFlags seen = 0;  // by views
  // Another program's: neither released nor tracked here, and in the layout `home` between
  // recordings.
  bool foreign = false;
  VkImageLayout home = VK_IMAGE_LAYOUT_UNDEFINED;
  gpu::TextureDesc desc;    // its label is not kept
  std::vector<View> views;  // made when they are first asked for
};

struct SamplerObject {
  VkSampler sampler = VK_NULL_HANDLE;
};

BufferObject makeBuffer(Context& context, std::string_view label, uint64_t size,
                        VkBufferUsageFlags usage, MemoryKind kind);
TextureObject makeTexture(Context& context, const gpu::TextureDesc& desc);
SamplerObject makeSampler(Context& context, const gpu::SamplerDesc& desc);

// `range` has no zero counts.
VkImageView viewOf(Context& context, TextureObject& texture, const gpu::TextureView& range,
                   VkImageViewType type);

// One subresource against tightly packed rows in a buffer, either way.
VkBufferImageCopy copyRegion(const gpu::TextureDesc& desc, uint32_t mip, uint32_t layer,
                             uint64_t bufferOffset);

void release(Context& context, BufferObject& object);
void release(Context& context, TextureObject& object);
void release(Context& context, SamplerObject& object);

}  // namespace grisaille::vulkan
