// SPDX-License-Identifier: MIT
// The Vulkan objects behind the layer's handles. Each struct is created and released as a whole. A
// member that is not created yet is null, and releasing null does nothing.
#pragma once

#include <cstddef>
#include <vector>

#include "backends/vulkan/context.h"

namespace grisaille::vulkan {

struct BufferObject {
  VkBuffer buffer = VK_NULL_HANDLE;
  Memory memory;
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
  Memory memory;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageAspectFlags seen = 0;  // aspects that views show
  // Another program's image. The layer neither releases nor tracks it. It is in the layout `home`
  // between recordings.
  bool foreign = false;
  VkImageLayout home = VK_IMAGE_LAYOUT_UNDEFINED;
  uint32_t firstLayer = 0;  // of a foreign image: the layer that is layer 0 here
  gpu::TextureDesc desc;    // its label is not kept
  std::vector<View> views;  // created on first use
};

struct SamplerObject {
  VkSampler sampler = VK_NULL_HANDLE;
};

BufferObject makeBuffer(Context& context, std::string_view label, uint64_t size,
                        VkBufferUsageFlags usage, MemoryKind kind);
TextureObject makeTexture(Context& context, const gpu::TextureDesc& desc);
SamplerObject makeSampler(Context& context, const gpu::SamplerDesc& desc);

// Bytes of memory that an object takes.
uint64_t bufferBytes(const Context& context, uint64_t size, VkBufferUsageFlags usage);
uint64_t textureBytes(const Context& context, const gpu::TextureDesc& desc);

// Returns the cached view, or creates it. `range` has no zero counts.
VkImageView viewOf(Context& context, TextureObject& texture, const gpu::TextureView& range,
                   VkImageViewType type);

// The region of a copy between one subresource and tightly packed rows in a buffer, in either
// direction.
VkBufferImageCopy copyRegion(const gpu::TextureDesc& desc, uint32_t mip, uint32_t layer,
                             uint64_t bufferOffset);

void release(Context& context, BufferObject& object);
void release(Context& context, TextureObject& object);
void release(Context& context, SamplerObject& object);

}  // namespace grisaille::vulkan
