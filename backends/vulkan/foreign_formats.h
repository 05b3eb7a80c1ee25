// SPDX-License-Identifier: MIT
// Textures of other programs, in the formats that a shader samples as floats.
#pragma once

#include "backends/vulkan/objects.h"

namespace grisaille::vulkan {

struct ForeignFormat {
  VkFormat format;
  const char* name;            // "VK_FORMAT_D16_UNORM"
  uint32_t channels;           // 1 ... 4
  VkImageAspectFlags aspects;  // all aspects of the format: barriers must name each

  bool depth() const { return (aspects & VK_IMAGE_ASPECT_DEPTH_BIT) != 0; }
};

// Throws kHostTexture if the format is not in the table.
const ForeignFormat& foreignFormat(VkFormat format);

// The aspects that a barrier to or from this layout names.
VkImageAspectFlags aspectsIn(VkImageLayout layout, const ForeignFormat& format);

// Creates a view of each layer of the texture. The caller owns the view, the other program owns the
// image. Throws kHostTexture, kOutOfDeviceMemory.
TextureObject makeForeign(Context& context, const gpu::ForeignTexture& texture);

}  // namespace grisaille::vulkan
