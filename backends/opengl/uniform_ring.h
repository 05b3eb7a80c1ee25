// SPDX-License-Identifier: MIT
// Memory for the uniforms of the frames in flight. The CPU writes it through a persistent mapping,
// and reuses a frame's memory once the frame's fence has signalled.
#pragma once

#include <span>
#include <vector>

#include "backends/opengl/resources.h"

namespace grisaille::opengl {

constexpr uint32_t kFramesInFlight = 2;

class UniformRing {
 public:
  // `alignment`: required alignment of a uniform binding's offset, in bytes.
  UniformRing(Resources& resources, uint32_t alignment)
      : resources_(resources), alignment_(alignment) {}

  // Starts over in the memory of `slot`, 0 ... kFramesInFlight - 1. The GPU must have finished the
  // frame that used it.
  void beginFrame(uint32_t slot);

  gpu::BufferRange push(std::span<const std::byte> bytes);

 private:
  struct Chunk {
    gpu::Buffer buffer;
    std::byte* memory = nullptr;
    uint64_t size = 0;
  };

  Chunk makeChunk(uint64_t size);

  Resources& resources_;
  uint64_t alignment_;
  std::array<std::vector<Chunk>, kFramesInFlight> chunks_;
  uint32_t slot_ = 0;
  uint64_t used_ = 0;  // bytes of the slot's last chunk
};

}  // namespace grisaille::opengl
