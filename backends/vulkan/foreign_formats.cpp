// SPDX-License-Identifier: MIT
#include "backends/vulkan/foreign_formats.h"

#include <algorithm>

namespace grisaille::vulkan {
namespace {

constexpr VkImageAspectFlags kColour = VK_IMAGE_ASPECT_COLOR_BIT;
constexpr VkImageAspectFlags kDepthAlone = VK_IMAGE_ASPECT_DEPTH_BIT;
constexpr VkImageAspectFlags kBoth = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;

constexpr ForeignFormat kForeignFormats[] = {
    {VK_FORMAT_D16_UNORM, 1, kDepthAlone},
    {VK_FORMAT_X8_D24_UNORM_PACK32, 1, kDepthAlone},
    {VK_FORMAT_D32_SFLOAT, 1, kDepthAlone},
    {VK_FORMAT_D16_UNORM_S8_UINT, 1, kBoth},
    {VK_FORMAT_D24_UNORM_S8_UINT, 1, kBoth},
    {VK_FORMAT_D32_SFLOAT_S8_UINT, 1, kBoth},
    {VK_FORMAT_R8_UNORM, 1, kColour},
    {VK_FORMAT_R16_UNORM, 1, kColour},
    {VK_FORMAT_R16_SFLOAT, 1, kColour},
    {VK_FORMAT_R32_SFLOAT, 1, kColour},
    {VK_FORMAT_R16G16_SFLOAT, 2, kColour},
    {VK_FORMAT_R32G32_SFLOAT, 2, kColour},
    {VK_FORMAT_B10G11R11_UFLOAT_PACK32, 3, kColour},
    {VK_FORMAT_R32G32B32_SFLOAT, 3, kColour},
    {VK_FORMAT_R8G8B8A8_UNORM, 4, kColour},
    {VK_FORMAT_R8G8B8A8_SNORM, 4, kColour},
    {VK_FORMAT_R8G8B8A8_SRGB, 4, kColour},
    {VK_FORMAT_B8G8R8A8_UNORM, 4, kColour},
    {VK_FORMAT_B8G8R8A8_SRGB, 4, kColour},
    {VK_FORMAT_A8B8G8R8_UNORM_PACK32, 4, kColour},
    {VK_FORMAT_A8B8G8R8_SNORM_PACK32, 4, kColour},
    {VK_FORMAT_A8B8G8R8_SRGB_PACK32, 4, kColour},
    {VK_FORMAT_A2R10G10B10_UNORM_PACK32, 4, kColour},
    {VK_FORMAT_A2B10G10R10_UNORM_PACK32, 4, kColour},
    {VK_FORMAT_R16G16B16A16_UNORM, 4, kColour},
    {VK_FORMAT_R16G16B16A16_SNORM, 4, kColour},
    {VK_FORMAT_R16G16B16A16_SFLOAT, 4, kColour},
    {VK_FORMAT_R32G32B32A32_SFLOAT, 4, kColour},
};

}  // namespace

const ForeignFormat& foreignFormat(VkFormat format) {
  const auto found = std::ranges::find(kForeignFormats, format, &ForeignFormat::format);
  if (found != std::end(kForeignFormats)) return *found;
  throw Error(ErrorId::kHostTexture, "VkFormat {} is not one of the formats sampled as floats",
              static_cast<int>(format));
}

TextureObject makeForeign(Context& context, const gpu::ForeignTexture& texture) {
  const auto format = static_cast<VkFormat>(texture.format);
  const auto layout = static_cast<VkImageLayout>(texture.layout);
  const ForeignFormat& known = foreignFormat(format);
  if (texture.name == 0) throw Error(ErrorId::kHostTexture, "its image is VK_NULL_HANDLE");
  if (layout == VK_IMAGE_LAYOUT_UNDEFINED || layout == VK_IMAGE_LAYOUT_PREINITIALIZED) {
    throw Error(ErrorId::kHostTexture, "an image in layout {} has no contents to read",
                texture.layout);
  }
  const uint32_t most = context.info.capabilities.maxTextureSize;
  if (texture.width < 1 || texture.width > most || texture.height < 1 || texture.height > most) {
    throw Error(ErrorId::kHostTexture, "it has {} x {} pixels, outside 1 to {}", texture.width,
                texture.height, most);
  }
  VkFormatProperties has{};
  vkGetPhysicalDeviceFormatProperties(context.physical, format, &has);
  if ((has.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) == 0) {
    throw Error(ErrorId::kHostTexture, "{} does not sample VkFormat {}", context.info.name,
                texture.format);
  }
  TextureObject object;
  object.image = reinterpret_cast<VkImage>(texture.name);
  object.foreign = true;
  object.home = layout;
  object.format = format;
  object.seen = known.depth() ? kDepthAlone : kColour;
  object.desc.format = gpu::Format::kRgba32Float;  // as shaders see it, whatever its channels
  object.desc.width = texture.width;
  object.desc.height = texture.height;
  object.desc.usage = gpu::TextureUsage::kSampled;
  viewOf(context, object, {.texture = {}, .mip = 0, .mipCount = 1, .layer = 0, .layerCount = 1},
         VK_IMAGE_VIEW_TYPE_2D);
  return object;
}

}  // namespace grisaille::vulkan
