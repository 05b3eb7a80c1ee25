// SPDX-License-Identifier: MIT
// Runs random uses through the state tracker and its barriers through a model of Vulkan's memory.
// At every use the layout must be valid, earlier writes must be available and visible, and reads
// must finish before their memory is overwritten.
#include <gtest/gtest.h>

#include <random>

#include "backends/vulkan/barriers.h"

namespace grisaille::vulkan {
namespace {

using gpu::Access;

// An operation, and the stages known to run after it.
struct Ordered {
  VkPipelineStageFlags2 origin = 0;  // the operation is in one of these
  VkPipelineStageFlags2 after = 0;

  bool reachedBy(VkPipelineStageFlags2 source) const {
    return (origin & ~source) == 0 || (after & source) != 0;
  }
};

// State of one subresource or buffer.
class Memory {
 public:
  explicit Memory(bool image) : image_(image) {}

  void barrier(const Scope& source, VkAccessFlags2 sourceWrites, const Scope& target,
               VkImageLayout from, VkImageLayout to) {
    const bool transition = image_ && from != to;
    if (transition) {
      EXPECT_TRUE(from == VK_IMAGE_LAYOUT_UNDEFINED ? !written_ : from == layout_)
          << "the old layout is wrong";
    }
    if (written_ && write_.reachedBy(source.stages)) {
      if ((unavailable_ & ~sourceWrites) == 0) unavailable_ = 0;
      if (unavailable_ == 0) visible_.push_back(target);
      write_.after |= target.stages;
    } else if (written_ && transition) {
      ADD_FAILURE() << "a transition races with a write";
    }
    for (Ordered& read : reads_) {
      if (read.reachedBy(source.stages)) {
        read.after |= target.stages;
      } else if (transition) {
        ADD_FAILURE() << "a transition races with a read";
      }
    }
    if (!transition) return;
    // A transition reads and writes the memory; its result is visible only to the barrier's
    // destination.
    EXPECT_EQ(unavailable_, 0u) << "a transition loses a write";
    layout_ = to;
    written_ = true;
    write_ = {.origin = target.stages, .after = target.stages};
    visible_ = {target};
    reads_.clear();
  }

  void use(Access access) {
    const Scope scope = scopeOf(access);
    if (image_) {
      EXPECT_EQ(layout_, layoutOf(access));
    }
    if (written_) {
      EXPECT_EQ(unavailable_, 0u) << "a write is not available";
      EXPECT_TRUE(visibleTo(scope)) << "a write is not visible to " << static_cast<int>(access);
    }
    if (!has(access, gpu::kWriteAccess)) {
      reads_.push_back({.origin = scope.stages, .after = 0});
      return;
    }
    for (const Ordered& read : reads_) {
      EXPECT_EQ(scope.stages & ~read.after, 0u) << "a write races with a read";
    }
    reads_.clear();
    written_ = true;
    unavailable_ = writesIn(scope.accesses);
    visible_.clear();
    write_ = {.origin = scope.stages, .after = 0};
  }

 private:
  bool visibleTo(const Scope& scope) const {
    for (const Scope& one : visible_) {
      if ((scope.stages & ~one.stages) == 0 && (scope.accesses & ~one.accesses) == 0) return true;
    }
    return false;
  }

  bool image_;
  VkImageLayout layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
  bool written_ = false;
  VkAccessFlags2 unavailable_ = 0;
  Ordered write_;
  std::vector<Scope> visible_;
  std::vector<Ordered> reads_;
};

constexpr uint32_t kMips = 4, kLayers = 3;
constexpr gpu::Texture kTexture{0x10001};
constexpr gpu::Buffer kBuffer{0x10001};

class Walk {
 public:
  explicit Walk(uint32_t seed)
      : random_(seed), buffer_(false), levels_(kMips * kLayers, Memory(true)) {
    tracker_.add(kTexture, kMips, kLayers);
    tracker_.add(kBuffer);
  }

  void step() {
    std::vector<Access> used(levels_.size(), Access::kNone);
    for (uint32_t views = upTo(3); views > 0; --views) {
      static constexpr Access kUses[] = {Access::kSampled,
                                         Access::kStorageRead,
                                         Access::kStorageWrite,
                                         Access::kColorTarget,
                                         Access::kCopyRead,
                                         Access::kCopyWrite,
                                         Access::kStorageRead | Access::kStorageWrite};
      useView(kUses[upTo(std::size(kUses))], used);
    }
    static constexpr Access kBufferUses[] = {
        Access::kVertex,       Access::kIndex,    Access::kUniform,  Access::kStorageRead,
        Access::kStorageWrite, Access::kCopyRead, Access::kCopyWrite};
    Access buffer = Access::kNone;
    for (uint32_t uses = upTo(3); uses > 0; --uses) {
      const Access access = kBufferUses[upTo(std::size(kBufferUses))];
      tracker_.use(kBuffer, access);
      buffer = buffer | access;
    }
    for (const gpu::Transition& transition : tracker_.flush()) apply(transition);
    if (buffer != Access::kNone) buffer_.use(buffer);
    for (size_t i = 0; i < used.size(); ++i) {
      if (used[i] != Access::kNone) levels_[i].use(used[i]);
    }
  }

 private:
  uint32_t upTo(size_t end) { return static_cast<uint32_t>(random_() % end); }

  void useView(Access access, std::vector<Access>& used) {
    gpu::TextureView view{.texture = kTexture, .mip = upTo(kMips), .layer = upTo(kLayers)};
    view.mipCount = 1 + upTo(kMips - view.mip);
    view.layerCount = 1 + upTo(kLayers - view.layer);
    tracker_.use(view, access);
    for (uint32_t layer = view.layer; layer < view.layer + view.layerCount; ++layer) {
      for (uint32_t mip = view.mip; mip < view.mip + view.mipCount; ++mip) {
        Access& one = used[layer * kMips + mip];
        one = one | access;
      }
    }
  }

  void apply(const gpu::Transition& transition) {
    if (transition.buffer) {
      const auto made = bufferBarrier(transition, VK_NULL_HANDLE);
      buffer_.barrier({made.srcStageMask, 0}, made.srcAccessMask,
                      {made.dstStageMask, made.dstAccessMask}, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_UNDEFINED);
      return;
    }
    const auto made = imageBarrier(transition, VK_NULL_HANDLE, VK_IMAGE_ASPECT_COLOR_BIT);
    const VkImageSubresourceRange& range = made.subresourceRange;
    for (uint32_t layer = 0; layer < range.layerCount; ++layer) {
      for (uint32_t mip = 0; mip < range.levelCount; ++mip) {
        levels_[(range.baseArrayLayer + layer) * kMips + range.baseMipLevel + mip].barrier(
            {made.srcStageMask, 0}, made.srcAccessMask, {made.dstStageMask, made.dstAccessMask},
            made.oldLayout, made.newLayout);
      }
    }
  }

  std::mt19937 random_;
  gpu::StateTracker tracker_;
  Memory buffer_;
  std::vector<Memory> levels_;
};

TEST(BarrierWalk, RandomUsesAreOrdered) {
  for (uint32_t seed = 0; seed < 200 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Walk walk(seed);
    for (int i = 0; i < 100 && !HasFailure(); ++i) walk.step();
  }
}

}  // namespace
}  // namespace grisaille::vulkan
