// SPDX-License-Identifier: MIT
#include "backends/opengl/uniform_ring.h"

#include <algorithm>
#include <cstring>

namespace grisaille::opengl {
namespace {

constexpr uint64_t kFirstChunk = 256 * 1024;  // bytes

}  // namespace

void UniformRing::beginFrame(uint32_t slot) {
  if (slot >= chunks_.size()) chunks_.resize(slot + 1);
  slot_ = slot;
  current_ = 0;
  used_ = 0;
}

gpu::BufferRange UniformRing::push(std::span<const std::byte> bytes) {
  std::vector<Chunk>& chunks = chunks_[slot_];
  uint64_t offset = (used_ + alignment_ - 1) / alignment_ * alignment_;
  while (current_ == chunks.size() || offset + bytes.size() > chunks[current_].size) {
    if (current_ < chunks.size()) ++current_;
    offset = 0;
    if (current_ < chunks.size()) continue;
    const uint64_t last = chunks.empty() ? kFirstChunk / 2 : chunks.back().size;
    chunks.push_back(makeChunk(std::max<uint64_t>(last * 2, bytes.size())));
  }
  used_ = offset + bytes.size();
  const Chunk& chunk = chunks[current_];
  std::memcpy(chunk.memory + offset, bytes.data(), bytes.size());
  return {.buffer = chunk.buffer, .offset = offset, .size = bytes.size()};
}

void UniformRing::prepare(uint32_t slots) {
  if (slots > chunks_.size()) chunks_.resize(slots);
  const std::vector<Chunk>& own = chunks_[slot_];
  for (uint32_t slot = 0; slot < slots; ++slot) {
    std::vector<Chunk>& chunks = chunks_[slot];
    while (chunks.size() < own.size()) chunks.push_back(makeChunk(own[chunks.size()].size));
  }
}

UniformRing::Chunk UniformRing::makeChunk(uint64_t size) {
  Chunk chunk;
  chunk.size = size;
  chunk.buffer = resources_.createMapped(size, chunk.memory);
  return chunk;
}

}  // namespace grisaille::opengl
