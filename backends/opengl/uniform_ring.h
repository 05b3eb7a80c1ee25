// SPDX-License-Identifier: MIT
// Memory for the uniforms of the frames in flight. The CPU writes it through a persistent mapping.
// Each frame takes a slot, which the next one reuses once the GPU has finished the frame.
#pragma once

#include <span>
#include <vector>

#include "backends/opengl/resources.h"

namespace grisaille::opengl {

class UniformRing {
 public:
  // `alignment`: required alignment of a uniform binding's offset, in bytes.
  UniformRing(Resources& resources, uint32_t alignment)
      : resources_(resources), alignment_(alignment) {}

  // Starts over in the memory of `slot`, any number from 0. The GPU must have finished the frame
  // that used it.
  void beginFrame(uint32_t slot);

  gpu::BufferRange push(std::span<const std::byte> bytes);

  // Gives every slot below `slots` as much memory as the current frame has used, so that equal
  // frames in these slots allocate nothing.
  void prepare(uint32_t slots);

 private:
  struct Chunk {
    gpu::Buffer buffer;
    std::byte* memory = nullptr;
    uint64_t size = 0;
  };

  Chunk makeChunk(uint64_t size);

  Resources& resources_;
  uint64_t alignment_;
  std::vector<std::vector<Chunk>> chunks_;  // by slot
  uint32_t slot_ = 0;
  size_t current_ = 0;  // chunk of the slot
  uint64_t used_ = 0;   // bytes of that chunk
};

}  // namespace grisaille::opengl
