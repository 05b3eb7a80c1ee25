// SPDX-License-Identifier: MIT
// The mapping from accesses to Vulkan, for every combination of accesses before and after.
#include "backends/vulkan/barriers.h"

#include <gtest/gtest.h>

#include <bit>

namespace grisaille::vulkan {
namespace {

using gpu::Access;

constexpr int kAccessBits = 10;
constexpr int kAccessSets = 1 << kAccessBits;

// The stages that support an access, by the specification's table of supported access types.
VkPipelineStageFlags2 stagesThatMay(VkAccessFlags2 access) {
  constexpr VkPipelineStageFlags2 kShaders = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                             VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                             VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  switch (access) {
    case VK_ACCESS_2_INDEX_READ_BIT:
      return VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT;
    case VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT:
      return VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
    case VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT:
    case VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT:
      return VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    case VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT:
    case VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT:
      return VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
             VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    case VK_ACCESS_2_TRANSFER_READ_BIT:
    case VK_ACCESS_2_TRANSFER_WRITE_BIT:
      return VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT;
    default:
      return kShaders;
  }
}

// Whether the specification allows this access to an image in this layout.
bool layoutAllows(VkImageLayout layout, Access access) {
  if (layout == VK_IMAGE_LAYOUT_GENERAL) return true;
  switch (access) {
    case Access::kSampled:
      return layout == VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
    case Access::kColorTarget:
    case Access::kDepthTarget:
      return layout == VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    case Access::kCopyRead:
      return layout == VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case Access::kCopyWrite:
      return layout == VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    default:
      return false;
  }
}

Access one(int bit) {
  return static_cast<Access>(1 << bit);
}

TEST(Barriers, EveryScopeIsOfItsUsesAndLegal) {
  for (int set = 0; set < kAccessSets; ++set) {
    const Scope scope = scopeOf(static_cast<Access>(set));
    Scope expected;
    for (int bit = 0; bit < kAccessBits; ++bit) {
      if ((set >> bit & 1) == 0) continue;
      const Scope part = scopeOf(one(bit));
      EXPECT_NE(part.stages, 0u) << bit;
      EXPECT_NE(part.accesses, 0u) << bit;
      EXPECT_EQ(writesIn(part.accesses) != 0, has(gpu::kWriteAccess, one(bit))) << bit;
      expected.stages |= part.stages;
      expected.accesses |= part.accesses;
    }
    ASSERT_EQ(scope.stages, expected.stages) << set;
    ASSERT_EQ(scope.accesses, expected.accesses) << set;
    for (uint64_t rest = scope.accesses; rest != 0; rest &= rest - 1) {
      const VkAccessFlags2 access = uint64_t{1} << std::countr_zero(rest);
      ASSERT_NE(scope.stages & stagesThatMay(access), 0u) << set << " " << access;
    }
  }
}

// Readbacks copy, presentation blits to windows; uploads only copy.
TEST(Barriers, CopiesAreReadByBothCommands) {
  EXPECT_EQ(scopeOf(Access::kCopyRead).stages,
            VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT);
  EXPECT_EQ(scopeOf(Access::kCopyWrite).stages, VK_PIPELINE_STAGE_2_COPY_BIT);
}

TEST(Barriers, EveryLayoutAllowsItsUses) {
  EXPECT_EQ(layoutOf(Access::kNone), VK_IMAGE_LAYOUT_UNDEFINED);
  for (int set = 1; set < kAccessSets; ++set) {
    const VkImageLayout layout = layoutOf(static_cast<Access>(set));
    for (int bit = 0; bit < kAccessBits; ++bit) {
      if ((set >> bit & 1) == 0) continue;
      ASSERT_TRUE(layoutAllows(layout, one(bit))) << set << " " << bit;
    }
  }
  for (const Access access :
       {Access::kSampled, Access::kColorTarget, Access::kDepthTarget, Access::kCopyRead}) {
    EXPECT_NE(layoutOf(access), VK_IMAGE_LAYOUT_GENERAL) << static_cast<int>(access);
  }
}

TEST(Barriers, EveryPairMakesWritesAvailableAndVisible) {
  gpu::Transition transition;
  transition.mip = 2;
  transition.mipCount = 3;
  transition.layer = 4;
  transition.layerCount = 5;
  for (int before = 0; before < kAccessSets; ++before) {
    for (int after = 1; after < kAccessSets; ++after) {
      transition.before = static_cast<Access>(before);
      transition.after = static_cast<Access>(after);
      const Scope from = scopeOf(transition.before), to = scopeOf(transition.after);
      const VkImageMemoryBarrier2 image =
          imageBarrier(transition, VK_NULL_HANDLE, VK_IMAGE_ASPECT_COLOR_BIT);
      // Undefined contents may still be in use by earlier frames.
      ASSERT_EQ(image.srcStageMask,
                before == 0 ? VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT : from.stages);
      ASSERT_EQ(image.srcAccessMask, writesIn(from.accesses));
      ASSERT_EQ(image.dstStageMask, to.stages);
      ASSERT_EQ(image.dstAccessMask, to.accesses);
      ASSERT_EQ(image.oldLayout, layoutOf(transition.before));
      ASSERT_EQ(image.newLayout, layoutOf(transition.after));
      ASSERT_NE(image.newLayout, VK_IMAGE_LAYOUT_UNDEFINED);
      const VkBufferMemoryBarrier2 buffer = bufferBarrier(transition, VK_NULL_HANDLE);
      ASSERT_EQ(buffer.srcStageMask, from.stages);
      ASSERT_EQ(buffer.srcAccessMask, writesIn(from.accesses));
      ASSERT_EQ(buffer.dstStageMask, to.stages);
      ASSERT_EQ(buffer.dstAccessMask, to.accesses);
    }
  }
}

TEST(Barriers, CoverTheWholeRange) {
  gpu::Transition transition;
  transition.mip = 2;
  transition.mipCount = 3;
  transition.layer = 4;
  transition.layerCount = 5;
  transition.after = Access::kSampled;
  const auto image = imageBarrier(transition, VK_NULL_HANDLE, aspectOf(gpu::Format::kD32Float));
  EXPECT_EQ(image.subresourceRange.aspectMask, static_cast<uint32_t>(VK_IMAGE_ASPECT_DEPTH_BIT));
  EXPECT_EQ(image.subresourceRange.baseMipLevel, 2u);
  EXPECT_EQ(image.subresourceRange.levelCount, 3u);
  EXPECT_EQ(image.subresourceRange.baseArrayLayer, 4u);
  EXPECT_EQ(image.subresourceRange.layerCount, 5u);
  const auto buffer = bufferBarrier(transition, VK_NULL_HANDLE);
  EXPECT_EQ(buffer.offset, 0u);
  EXPECT_EQ(buffer.size, VK_WHOLE_SIZE);
  EXPECT_EQ(aspectOf(gpu::Format::kR32Float), static_cast<uint32_t>(VK_IMAGE_ASPECT_COLOR_BIT));
}

}  // namespace
}  // namespace grisaille::vulkan
