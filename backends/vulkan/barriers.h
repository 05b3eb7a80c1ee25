// SPDX-License-Identifier: MIT
// Translates the layer's accesses to Vulkan stages, access flags, image layouts and barriers. Pure
// functions.
#pragma once

#include "backends/vulkan/api.h"
#include "core/gpu/state_tracker.h"

namespace grisaille::vulkan {

struct Scope {
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 accesses = VK_ACCESS_2_NONE;
};

// The stages and access flags of `access`. Shader accesses include all shader stages: a read that
// follows a read of the same kind gets no barrier, whichever stage reads.
Scope scopeOf(gpu::Access access);

// The flags of `accesses` that write.
VkAccessFlags2 writesIn(VkAccessFlags2 accesses);

// The layout that a subresource must have for `access`: UNDEFINED for kNone, GENERAL if two uses
// of one call need different layouts.
VkImageLayout layoutOf(gpu::Access access);

VkImageAspectFlags aspectOf(gpu::Format format);

VkBufferMemoryBarrier2 bufferBarrier(const gpu::Transition& transition, VkBuffer buffer);
VkImageMemoryBarrier2 imageBarrier(const gpu::Transition& transition, VkImage image,
                                   VkImageAspectFlags aspect);

}  // namespace grisaille::vulkan
