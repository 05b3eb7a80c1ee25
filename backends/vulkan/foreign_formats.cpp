// SPDX-License-Identifier: MIT
#include "backends/vulkan/foreign_formats.h"

#include <algorithm>

namespace grisaille::vulkan {
namespace {

constexpr VkImageAspectFlags kColour = VK_IMAGE_ASPECT_COLOR_BIT;
constexpr VkImageAspectFlags kDepthAlone = VK_IMAGE_ASPECT_DEPTH_BIT;
constexpr VkImageAspectFlags kBoth = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;

#define FORMAT(format, channels, aspects) \
  { format, #format, channels, aspects }
constexpr ForeignFormat kForeignFormats[] = {
    FORMAT(VK_FORMAT_D16_UNORM, 1, kDepthAlone),
    FORMAT(VK_FORMAT_X8_D24_UNORM_PACK32, 1, kDepthAlone),
    FORMAT(VK_FORMAT_D32_SFLOAT, 1, kDepthAlone),
    FORMAT(VK_FORMAT_D16_UNORM_S8_UINT, 1, kBoth),
    FORMAT(VK_FORMAT_D24_UNORM_S8_UINT, 1, kBoth),
    FORMAT(VK_FORMAT_D32_SFLOAT_S8_UINT, 1, kBoth),
    FORMAT(VK_FORMAT_R8_UNORM, 1, kColour),
    FORMAT(VK_FORMAT_R16_UNORM, 1, kColour),
    FORMAT(VK_FORMAT_R16_SFLOAT, 1, kColour),
    FORMAT(VK_FORMAT_R32_SFLOAT, 1, kColour),
    FORMAT(VK_FORMAT_R8G8_UNORM, 2, kColour),
    FORMAT(VK_FORMAT_R8G8_SNORM, 2, kColour),
    FORMAT(VK_FORMAT_R16G16_UNORM, 2, kColour),
    FORMAT(VK_FORMAT_R16G16_SNORM, 2, kColour),
    FORMAT(VK_FORMAT_R16G16_SFLOAT, 2, kColour),
    FORMAT(VK_FORMAT_R32G32_SFLOAT, 2, kColour),
    FORMAT(VK_FORMAT_B10G11R11_UFLOAT_PACK32, 3, kColour),
    FORMAT(VK_FORMAT_R32G32B32_SFLOAT, 3, kColour),
    FORMAT(VK_FORMAT_R8G8B8A8_UNORM, 4, kColour),
    FORMAT(VK_FORMAT_R8G8B8A8_SNORM, 4, kColour),
    FORMAT(VK_FORMAT_R8G8B8A8_SRGB, 4, kColour),
    FORMAT(VK_FORMAT_B8G8R8A8_UNORM, 4, kColour),
    FORMAT(VK_FORMAT_B8G8R8A8_SRGB, 4, kColour),
    FORMAT(VK_FORMAT_A8B8G8R8_UNORM_PACK32, 4, kColour),
    FORMAT(VK_FORMAT_A8B8G8R8_SNORM_PACK32, 4, kColour),
    FORMAT(VK_FORMAT_A8B8G8R8_SRGB_PACK32, 4, kColour),
    FORMAT(VK_FORMAT_A2R10G10B10_UNORM_PACK32, 4, kColour),
    FORMAT(VK_FORMAT_A2B10G10R10_UNORM_PACK32, 4, kColour),
    FORMAT(VK_FORMAT_R16G16B16A16_UNORM, 4, kColour),
    FORMAT(VK_FORMAT_R16G16B16A16_SNORM, 4, kColour),
    FORMAT(VK_FORMAT_R16G16B16A16_SFLOAT, 4, kColour),
    FORMAT(VK_FORMAT_R32G32B32A32_SFLOAT, 4, kColour),
};
#undef FORMAT

// Layouts in which an image has contents that a shader may read after a transition.
enum class For : uint8_t { kAll, kColourAlone, kDepths };
struct Layout {
  VkImageLayout layout;
  const char* name;
  For use;
};
#define LAYOUT(layout, use) \
  { layout, #layout, use }
constexpr Layout kLayouts[] = {
    LAYOUT(VK_IMAGE_LAYOUT_GENERAL, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, For::kColourAlone),
    LAYOUT(VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, For::kDepths),
    LAYOUT(VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL, For::kDepths),
    LAYOUT(VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL, For::kDepths),
    LAYOUT(VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_STENCIL_READ_ONLY_OPTIMAL, For::kDepths),
    LAYOUT(VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, For::kDepths),
    LAYOUT(VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL, For::kDepths),
};
// Other layouts, for messages.
constexpr Layout kRefused[] = {
    LAYOUT(VK_IMAGE_LAYOUT_UNDEFINED, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_PREINITIALIZED, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, For::kAll),
    LAYOUT(VK_IMAGE_LAYOUT_STENCIL_ATTACHMENT_OPTIMAL, For::kDepths),
    LAYOUT(VK_IMAGE_LAYOUT_STENCIL_READ_ONLY_OPTIMAL, For::kDepths),
};
#undef LAYOUT

void checkLayout(VkImageLayout layout, const ForeignFormat& format) {
  const auto known = std::ranges::find(kLayouts, layout, &Layout::layout);
  if (known == std::end(kLayouts)) {
    const auto named = std::ranges::find(kRefused, layout, &Layout::layout);
    throw Error(ErrorId::kHostTexture,
                "the layout {} ({}) is none in which a renderer leaves a texture to be sampled",
                static_cast<int>(layout),
                named != std::end(kRefused) ? named->name : "not a VkImageLayout of Vulkan 1.3");
  }
  const bool fits = known->use == For::kAll || (known->use == For::kDepths) == format.depth();
  if (fits) return;
  throw Error(ErrorId::kHostTexture, "the layout {} ({}) is not one of images in {}",
              static_cast<int>(layout), known->name, format.name);
}

}  // namespace

const ForeignFormat& foreignFormat(VkFormat format) {
  const auto found = std::ranges::find(kForeignFormats, format, &ForeignFormat::format);
  if (found != std::end(kForeignFormats)) return *found;
  throw Error(ErrorId::kHostTexture, "VkFormat {} is not one of the formats sampled as floats",
              static_cast<int>(format));
}

// Layouts of the depth aspect alone say nothing of the stencil aspect.
VkImageAspectFlags aspectsIn(VkImageLayout layout, const ForeignFormat& format) {
  const bool depthAlone = layout == VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL ||
                          layout == VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL;
  return depthAlone ? kDepthAlone : format.aspects;
}

TextureObject makeForeign(Context& context, const gpu::ForeignTexture& texture) {
  const auto format = static_cast<VkFormat>(texture.format);
  const auto layout = static_cast<VkImageLayout>(texture.layout);
  const ForeignFormat& known = foreignFormat(format);
  if (texture.name == 0) throw Error(ErrorId::kHostTexture, "its image is VK_NULL_HANDLE");
  checkLayout(layout, known);
  const uint32_t most = context.info.capabilities.maxTextureSize;
  if (texture.width < 1 || texture.width > most || texture.height < 1 || texture.height > most) {
    throw Error(ErrorId::kHostTexture, "it has {} x {} pixels, outside 1 to {}", texture.width,
                texture.height, most);
  }
  const uint32_t mostLayers = context.info.capabilities.maxTextureLayers;
  if (texture.layers < 1 || texture.firstLayer >= mostLayers ||
      texture.layers > mostLayers - texture.firstLayer) {
    throw Error(ErrorId::kHostTexture, "it has the layers {} to {} + {}, outside 0 to {}",
                texture.firstLayer, texture.firstLayer, texture.layers, mostLayers);
  }
  VkFormatProperties has{};
  vkGetPhysicalDeviceFormatProperties(context.physical, format, &has);
  if ((has.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) == 0) {
    throw Error(ErrorId::kHostTexture, "{} does not sample {} ({})", context.info.name, known.name,
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
  object.desc.layers = texture.layers;
  object.firstLayer = texture.firstLayer;
  object.desc.usage = gpu::TextureUsage::kSampled;
  try {
    for (uint32_t layer = 0; layer < texture.layers; ++layer) {
      viewOf(context, object, {.mip = 0, .mipCount = 1, .layer = layer, .layerCount = 1},
             VK_IMAGE_VIEW_TYPE_2D);
    }
  } catch (...) {
    release(context, object);
    throw;
  }
  return object;
}

}  // namespace grisaille::vulkan
