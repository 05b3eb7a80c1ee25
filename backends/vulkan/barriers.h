// SPDX-License-Identifier: MIT
// What the layer's accesses mean in Vulkan: stages, access flags, image layouts, barriers. Pure
// functions.
#pragma once

#include "backends/vulkan/api.h"
#include "core/gpu/state_tracker.h"

namespace grisaille::vulkan {

struct Scope {
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 accesses = VK_ACCESS_2_NONE;
};

// Everything that a use of `access` may do. Shader accesses name all shader stages, since a read
// that follows a read of the same kind gets no barrier, whichever stage does it.
Scope scopeOf(gpu::Access access);

// The flags that write.
VkAccessFlags2 writesIn(VkAccessFlags2 accesses);

// The layout a subresource must be in for `access`. kNone: UNDEFINED. Where two uses of one call
// ask for different layouts, GENERAL.
VkImageLayout layoutOf(gpu::Access access);

VkImageAspectFlags aspectOf(gpu::Format format);

VkBufferMemoryBarrier2 bufferBarrier(const gpu::Transition& transition, VkBuffer buffer);
VkImageMemoryBarrier2 imageBarrier(const gpu::Transition& transition, VkImage image,
                                   VkImageAspectFlags aspect);

}  // namespace grisaille::vulkan
