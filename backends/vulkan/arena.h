// SPDX-License-Identifier: MIT
// Host memory from which the device reads one frame's uniform blocks and uploads. It grows as
// needed, and is reused when the frame has finished.
#pragma once

#include <span>
#include <vector>

#include "backends/vulkan/resources.h"

namespace grisaille::vulkan {

class Arena {
 public:
  Arena(Context& context, Resources& resources);
  ~Arena() { reset(); }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // Copies `bytes` to an offset that is aligned for uniform bindings and copies.
  gpu::BufferRange copy(std::span<const std::byte> bytes);

  // Makes room for copies without any, so that the first of them allocates nothing.
  void prepare() {
    if (chunks_.empty()) addChunk(kChunkBytes);
  }

  // Frees all copies. The device must have finished with them.
  void reset();

 private:
  static constexpr uint64_t kChunkBytes = 1 << 20;

  struct Chunk {
    gpu::Buffer buffer;
    uint64_t size = 0;
  };

  void addChunk(uint64_t size);

  Resources& resources_;
  uint64_t alignment_ = 16;  // bytes: the largest texel's, or more if the device requires it
  std::vector<Chunk> chunks_;
  uint64_t used_ = 0;  // bytes used in the last chunk
};

}  // namespace grisaille::vulkan
