// SPDX-License-Identifier: MIT
#include "backends/vulkan/arena.h"

#include <algorithm>
#include <cstring>

namespace grisaille::vulkan {

Arena::Arena(Context& context, Resources& resources) : resources_(resources) {
  const VkPhysicalDeviceLimits& limits = context.properties.limits;
  alignment_ = std::max({alignment_, limits.minUniformBufferOffsetAlignment,
                         limits.optimalBufferCopyOffsetAlignment});
}

gpu::BufferRange Arena::copy(std::span<const std::byte> bytes) {
  uint64_t offset = (used_ + alignment_ - 1) / alignment_ * alignment_;
  if (chunks_.empty() || offset > chunks_.back().size ||
      bytes.size() > chunks_.back().size - offset) {
    addChunk(std::max<uint64_t>(kChunkBytes, bytes.size()));
    offset = 0;
  }
  const gpu::Buffer buffer = chunks_.back().buffer;
  if (!bytes.empty()) {
    std::memcpy(resources_.get(buffer).mapped + offset, bytes.data(), bytes.size());
  }
  used_ = offset + bytes.size();
  return {buffer, offset, bytes.size()};
}

void Arena::addChunk(uint64_t size) {
  chunks_.reserve(chunks_.size() + 1);
  const gpu::Buffer buffer = resources_.addUntracked(
      "upload", size, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
      MemoryKind::kUpload);
  chunks_.push_back({buffer, size});
}

// Keeps one chunk of kChunkBytes for the next frame.
void Arena::reset() {
  used_ = 0;
  const auto usual = std::find_if(chunks_.begin(), chunks_.end(),
                                  [](const Chunk& chunk) { return chunk.size == kChunkBytes; });
  if (usual != chunks_.end()) std::iter_swap(usual, chunks_.begin());
  const size_t kept = usual != chunks_.end() ? 1 : 0;
  for (size_t i = kept; i < chunks_.size(); ++i) resources_.retire(chunks_[i].buffer, 0);
  chunks_.resize(kept);
}

}  // namespace grisaille::vulkan
