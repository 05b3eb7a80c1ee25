// SPDX-License-Identifier: MIT
#include "backends/vulkan/objects.h"

#include <algorithm>

#include "backends/vulkan/barriers.h"

namespace grisaille::vulkan {
namespace {

VkImageCreateInfo imageInfo(const gpu::TextureDesc& desc) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = vulkanFormat(desc.format);
  info.extent = {desc.width, desc.height, 1};
  info.mipLevels = desc.mips;
  info.arrayLayers = desc.layers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (has(desc.usage, gpu::TextureUsage::kSampled)) info.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
  if (has(desc.usage, gpu::TextureUsage::kStorage)) info.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  if (has(desc.usage, gpu::TextureUsage::kTarget)) {
    info.usage |= gpu::formatInfo(desc.format).depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                     : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  }
  return info;
}

// Checks an image against the driver's limits of size in texels and in bytes.
void checkImageFits(const Context& context, const VkImageCreateInfo& info,
                    const gpu::TextureDesc& desc) {
  VkImageFormatProperties limits{};
  const VkResult result = vkGetPhysicalDeviceImageFormatProperties(
      context.physical, info.format, info.imageType, info.tiling, info.usage, info.flags, &limits);
  check(result, fmt::format("a texture of format {}", gpu::formatInfo(desc.format).name),
        ErrorId::kTextureFormat);
  // A format's limit may exceed the device's, which also bounds render targets and viewports.
  const uint32_t most = context.info.capabilities.maxTextureSize;
  const uint32_t width = std::min(limits.maxExtent.width, most);
  const uint32_t height = std::min(limits.maxExtent.height, most);
  if (desc.width > width || desc.height > height) {
    throw Error(ErrorId::kTextureSize, "texture '{}' has {}x{} texels, and {} allows {}x{}",
                desc.label, desc.width, desc.height, context.info.name, width, height);
  }
  uint64_t bytes = 0;
  for (uint32_t mip = 0; mip < desc.mips; ++mip) {
    bytes += uint64_t{std::max(1u, desc.width >> mip)} * std::max(1u, desc.height >> mip) *
             gpu::formatInfo(desc.format).texelBytes;
  }
  bytes *= desc.layers;
  if (bytes > limits.maxResourceSize) {
    throw Error(ErrorId::kOutOfDeviceMemory, "a texture of {} bytes is more than {} holds", bytes,
                context.info.name);
  }
}

VkBufferCreateInfo bufferInfo(uint64_t size, VkBufferUsageFlags usage) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  return info;
}

VkDeviceMemory memoryOf(const Memory& memory) {
  return reinterpret_cast<VkDeviceMemory>(memory.where.memory);
}

VkSamplerAddressMode addressMode(gpu::Address address) {
  switch (address) {
    case gpu::Address::kRepeat:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case gpu::Address::kMirror:
      return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    default:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  }
}

}  // namespace

BufferObject makeBuffer(Context& context, std::string_view label, uint64_t size,
                        VkBufferUsageFlags usage, MemoryKind kind) {
  const VolkDeviceTable& vk = context.vk;
  if (size > context.info.capabilities.maxBufferBytes) {
    throw Error(ErrorId::kOutOfDeviceMemory, "a buffer of {} bytes is more than {} holds", size,
                context.info.name);
  }
  BufferObject object;
  object.size = size;
  const VkBufferCreateInfo info = bufferInfo(size, usage);
  check(vk.vkCreateBuffer(context.device, &info, context.callbacks, &object.buffer),
        "vkCreateBuffer");
  try {
    Needing needing = {.buffer = object.buffer, .label = label};
    vk.vkGetBufferMemoryRequirements(context.device, object.buffer, &needing.requirements);
    object.memory = context.memory.allocate(needing, kind);
    check(vk.vkBindBufferMemory(context.device, object.buffer, memoryOf(object.memory),
                                object.memory.where.offset),
          "vkBindBufferMemory");
    object.mapped = static_cast<std::byte*>(object.memory.where.mapped);
  } catch (...) {
    release(context, object);
    throw;
  }
  context.name(VK_OBJECT_TYPE_BUFFER, object.buffer, label);
  return object;
}

TextureObject makeTexture(Context& context, const gpu::TextureDesc& desc) {
  const VolkDeviceTable& vk = context.vk;
  const VkImageCreateInfo info = imageInfo(desc);
  checkImageFits(context, info, desc);
  TextureObject object;
  object.desc = desc;
  object.desc.label = {};
  object.format = info.format;
  object.seen = aspectOf(desc.format);
  check(vk.vkCreateImage(context.device, &info, context.callbacks, &object.image), "vkCreateImage");
  try {
    Needing needing = {.image = object.image, .label = desc.label};
    vk.vkGetImageMemoryRequirements(context.device, object.image, &needing.requirements);
    object.memory = context.memory.allocate(needing, MemoryKind::kDevice);
    check(vk.vkBindImageMemory(context.device, object.image, memoryOf(object.memory),
                               object.memory.where.offset),
          "vkBindImageMemory");
  } catch (...) {
    release(context, object);
    throw;
  }
  context.name(VK_OBJECT_TYPE_IMAGE, object.image, desc.label);
  return object;
}

uint64_t bufferBytes(const Context& context, uint64_t size, VkBufferUsageFlags usage) {
  const VkBufferCreateInfo info = bufferInfo(size, usage);
  VkDeviceBufferMemoryRequirements of{VK_STRUCTURE_TYPE_DEVICE_BUFFER_MEMORY_REQUIREMENTS};
  of.pCreateInfo = &info;
  VkMemoryRequirements2 found{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  context.vk.vkGetDeviceBufferMemoryRequirements(context.device, &of, &found);
  return found.memoryRequirements.size;
}

uint64_t textureBytes(const Context& context, const gpu::TextureDesc& desc) {
  const VkImageCreateInfo info = imageInfo(desc);
  VkDeviceImageMemoryRequirements of{VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS};
  of.pCreateInfo = &info;
  VkMemoryRequirements2 found{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  context.vk.vkGetDeviceImageMemoryRequirements(context.device, &of, &found);
  return found.memoryRequirements.size;
}

SamplerObject makeSampler(Context& context, const gpu::SamplerDesc& desc) {
  const auto filter = [](gpu::Filter f) {
    return f == gpu::Filter::kLinear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  };
  const float anisotropy = std::min(desc.maxAnisotropy, context.info.capabilities.maxAnisotropy);
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = filter(desc.filter);
  info.mipmapMode = desc.mipFilter == gpu::Filter::kLinear ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                           : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = addressMode(desc.addressU);
  info.addressModeV = addressMode(desc.addressV);
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.anisotropyEnable = anisotropy > 1 ? VK_TRUE : VK_FALSE;
  info.maxAnisotropy = std::max(1.0f, anisotropy);
  info.maxLod = VK_LOD_CLAMP_NONE;
  SamplerObject object;
  check(context.vk.vkCreateSampler(context.device, &info, context.callbacks, &object.sampler),
        "vkCreateSampler");
  context.name(VK_OBJECT_TYPE_SAMPLER, object.sampler, desc.label);
  return object;
}

VkImageView viewOf(Context& context, TextureObject& texture, const gpu::TextureView& range,
                   VkImageViewType type) {
  for (const TextureObject::View& made : texture.views) {
    const gpu::TextureView& r = made.range;
    if (made.type == type && r.mip == range.mip && r.mipCount == range.mipCount &&
        r.layer == range.layer && r.layerCount == range.layerCount) {
      return made.view;
    }
  }
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = texture.image;
  info.viewType = type;
  info.format = texture.format;
  info.subresourceRange = {texture.seen, range.mip, range.mipCount,
                           texture.firstLayer + range.layer, range.layerCount};
  TextureObject::View made{.range = range, .type = type, .view = VK_NULL_HANDLE};
  texture.views.reserve(texture.views.size() + 1);
  check(context.vk.vkCreateImageView(context.device, &info, context.callbacks, &made.view),
        "vkCreateImageView");
  texture.views.push_back(made);
  return made.view;
}

VkBufferImageCopy copyRegion(const gpu::TextureDesc& desc, uint32_t mip, uint32_t layer,
                             uint64_t bufferOffset) {
  VkBufferImageCopy region{};
  region.bufferOffset = bufferOffset;
  region.imageSubresource = {aspectOf(desc.format), mip, layer, 1};
  region.imageExtent = {std::max(1u, desc.width >> mip), std::max(1u, desc.height >> mip), 1};
  return region;
}

void release(Context& context, BufferObject& object) {
  context.vk.vkDestroyBuffer(context.device, object.buffer, context.callbacks);
  context.memory.free(object.memory);
  object = {};
}

void release(Context& context, TextureObject& object) {
  for (const TextureObject::View& made : object.views) {
    context.vk.vkDestroyImageView(context.device, made.view, context.callbacks);
  }
  if (!object.foreign) context.vk.vkDestroyImage(context.device, object.image, context.callbacks);
  context.memory.free(object.memory);
  object = {};
}

void release(Context& context, SamplerObject& object) {
  context.vk.vkDestroySampler(context.device, object.sampler, context.callbacks);
  object = {};
}

}  // namespace grisaille::vulkan
