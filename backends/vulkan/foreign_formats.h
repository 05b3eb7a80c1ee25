// SPDX-License-Identifier: MIT
// Textures of other programs: those formats that a shader samples as floats.
#pragma once

#include "backends/vulkan/objects.h"

namespace grisaille::vulkan {

struct ForeignFormat {
  VkFormat format;
  uint32_t channels;           // 1 ... 4
  VkImageAspectFlags aspects;  // all that a layout is of

  bool depth() const { return (aspects & VK_IMAGE_ASPECT_DEPTH_BIT) != 0; }
};

// Throws kHostTexture for a format that is not in the table.
const ForeignFormat& foreignFormat(VkFormat format);

// The view alone is the layer's. Throws kHostTexture, kOutOfDeviceMemory.
TextureObject makeForeign(Context& context, const gpu::ForeignTexture& texture);

}  // namespace grisaille::vulkan
