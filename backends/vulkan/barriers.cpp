// SPDX-License-Identifier: MIT
#include "backends/vulkan/barriers.h"

namespace grisaille::vulkan {
namespace {

using gpu::Access;

constexpr VkPipelineStageFlags2 kShaders = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

struct Row {
  Access access;
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 accesses;
  VkImageLayout layout;
};

// Targets are also read: a colour target by its load, a depth target by the depth test.
constexpr Row kRows[] = {
    {Access::kVertex, VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
     VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, VK_IMAGE_LAYOUT_GENERAL},
    {Access::kIndex, VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT,
     VK_IMAGE_LAYOUT_GENERAL},
    {Access::kUniform, kShaders, VK_ACCESS_2_UNIFORM_READ_BIT, VK_IMAGE_LAYOUT_GENERAL},
    {Access::kSampled, kShaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
     VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL},
    {Access::kStorageRead, kShaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_IMAGE_LAYOUT_GENERAL},
    {Access::kStorageWrite, kShaders, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
     VK_IMAGE_LAYOUT_GENERAL},
    {Access::kColorTarget, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL},
    {Access::kDepthTarget,
     VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL},
    // Presentation blits pictures to windows.
    {Access::kCopyRead, VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT,
     VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
    {Access::kCopyWrite, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL},
};

}  // namespace

Scope scopeOf(Access access) {
  Scope scope;
  for (const Row& row : kRows) {
    if (!has(access, row.access)) continue;
    scope.stages |= row.stages;
    scope.accesses |= row.accesses;
  }
  return scope;
}

VkAccessFlags2 writesIn(VkAccessFlags2 accesses) {
  return accesses &
         (VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
          VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT);
}

VkImageLayout layoutOf(Access access) {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  for (const Row& row : kRows) {
    if (!has(access, row.access)) continue;
    const bool first = layout == VK_IMAGE_LAYOUT_UNDEFINED;
    layout = first || layout == row.layout ? row.layout : VK_IMAGE_LAYOUT_GENERAL;
  }
  return layout;
}

VkImageAspectFlags aspectOf(gpu::Format format) {
  return gpu::formatInfo(format).depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkBufferMemoryBarrier2 bufferBarrier(const gpu::Transition& transition, VkBuffer buffer) {
  const Scope before = scopeOf(transition.before), after = scopeOf(transition.after);
  VkBufferMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2};
  barrier.srcStageMask = before.stages;
  barrier.srcAccessMask = writesIn(before.accesses);
  barrier.dstStageMask = after.stages;
  barrier.dstAccessMask = after.accesses;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.buffer = buffer;
  barrier.size = VK_WHOLE_SIZE;
  return barrier;
}

VkImageMemoryBarrier2 imageBarrier(const gpu::Transition& transition, VkImage image,
                                   VkImageAspectFlags aspect) {
  const Scope before = scopeOf(transition.before), after = scopeOf(transition.after);
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  // A texture whose contents a host dropped may be in use by earlier frames.
  const bool undefined = transition.before == Access::kNone;
  barrier.srcStageMask = undefined ? VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT : before.stages;
  barrier.srcAccessMask = writesIn(before.accesses);
  barrier.dstStageMask = after.stages;
  barrier.dstAccessMask = after.accesses;
  barrier.oldLayout = layoutOf(transition.before);
  barrier.newLayout = layoutOf(transition.after);
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {aspect, transition.mip, transition.mipCount, transition.layer,
                              transition.layerCount};
  return barrier;
}

}  // namespace grisaille::vulkan
