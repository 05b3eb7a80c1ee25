// SPDX-License-Identifier: MIT
// Host memory that one frame hands to the device: uniform blocks and uploads. It grows as needed
// and starts anew when the frame has finished.
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

  // The bytes' copy, aligned for uniform bindings and copies.
  gpu::BufferRange copy(std::span<const std::byte> bytes);

  // The device has finished with all of it.
  void reset();

 private:
  static constexpr uint64_t kChunkBytes = 1 << 20;

  struct Chunk {
    gpu::Buffer buffer;
    uint64_t size = 0;
  };

  Resources& resources_;
  uint64_t alignment_ = 16;  // bytes: the largest texel's, and what the device asks for
  std::vector<Chunk> chunks_;
  uint64_t used_ = 0;  // bytes of the last chunk
};

}  // namespace grisaille::vulkan
