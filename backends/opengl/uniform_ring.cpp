// SPDX-License-Identifier: MIT
#include "backends/opengl/uniform_ring.h"

#include <algorithm>
#include <cstring>

namespace grisaille::opengl {
namespace {

constexpr uint64_t kFirstChunk = 256 * 1024;  // bytes

}  // namespace

void UniformRing::beginFrame(uint32_t slot) {
  slot_ = slot;
  used_ = 0;
  std::vector<Chunk>& chunks = chunks_[slot_];
  if (chunks.size() < 2) return;
  // Replace the chunks by one of their total size, enough for the slot's previous frame.
  uint64_t total = 0;
  for (const Chunk& chunk : chunks) {
    total += chunk.size;
    resources_.destroy(chunk.buffer);
  }
  chunks.clear();
  chunks.push_back(makeChunk(total));
}

gpu::BufferRange UniformRing::push(std::span<const std::byte> bytes) {
  std::vector<Chunk>& chunks = chunks_[slot_];
  uint64_t offset = (used_ + alignment_ - 1) / alignment_ * alignment_;
  if (chunks.empty() || offset + bytes.size() > chunks.back().size) {
    const uint64_t last = chunks.empty() ? kFirstChunk / 2 : chunks.back().size;
    chunks.push_back(makeChunk(std::max<uint64_t>(last * 2, bytes.size())));
    offset = 0;
  }
  used_ = offset + bytes.size();
  std::memcpy(chunks.back().memory + offset, bytes.data(), bytes.size());
  return {.buffer = chunks.back().buffer, .offset = offset, .size = bytes.size()};
}

UniformRing::Chunk UniformRing::makeChunk(uint64_t size) {
  Chunk chunk;
  chunk.size = size;
  chunk.buffer = resources_.createMapped(size, chunk.memory);
  return chunk;
}

}  // namespace grisaille::opengl
