// SPDX-License-Identifier: MIT
#include "host/pool.h"

#include <algorithm>
#include <utility>

namespace grisaille::host {
namespace {

// Recordings of a size after which a resource that none of them used is destroyed.
constexpr uint32_t kIdle = 3;

bool alike(const gpu::TextureDesc& a, const gpu::TextureDesc& b) {
  return a.format == b.format && a.width == b.width && a.height == b.height && a.mips == b.mips &&
         a.layers == b.layers && a.usage == b.usage;
}

bool alike(const gpu::BufferDesc& a, const gpu::BufferDesc& b) {
  return a.size == b.size && a.usage == b.usage;
}

}  // namespace

template <typename Entries, typename Desc, typename Create>
auto Pool::take(Entries& entries, const Desc& desc, State state, const Create& create) {
  const Size now = recent_.empty() ? Size() : recent_.back();
  const auto found = std::ranges::find_if(entries, [&](const auto& entry) {
    return entry.state == State::kFree && entry.label == desc.label && alike(entry.desc, desc);
  });
  if (found != entries.end()) {
    found->state = state;
    found->size = now;
    found->idle = 0;
    return found->handle;
  }
  entries.reserve(entries.size() + 1);
  typename Entries::value_type made = {.handle = {},
                                       .desc = desc,
                                       .label = std::string(desc.label),
                                       .bytes = sizes_.bytesOf(desc),
                                       .state = state,
                                       .size = now,
                                       .idle = 0};
  made.desc.label = {};
  made.handle = create(desc);
  use_.deviceBytes += made.bytes;
  ++use_.allocations;
  entries.push_back(std::move(made));
  return entries.back().handle;
}

template <typename Entries, typename Handle>
void Pool::giveBack(Entries& entries, Handle handle) {
  if (!handle) return;
  const auto found =
      std::ranges::find_if(entries, [&](const auto& entry) { return entry.handle == handle; });
  if (found == entries.end()) {  // tells what is wrong with it
    ForwardingMaker::destroy(handle);
    return;
  }
  found->state = State::kFree;
  found->idle = 0;
  const bool kept = std::ranges::find(recent_, found->size) != recent_.end();
  if (recording_ && kept) return;
  release(entries, [&](const auto& entry) { return entry.handle == handle; });
}

// Destroys the free entries that meet the condition.
template <typename Entries, typename Condition>
void Pool::release(Entries& entries, const Condition& condition) {
  std::erase_if(entries, [&](const auto& entry) {
    if (entry.state != State::kFree || !condition(entry)) return false;
    ForwardingMaker::destroy(entry.handle);
    use_.deviceBytes -= entry.bytes;
    --use_.allocations;
    return true;
  });
}

template <typename Entries>
void Pool::finish(Entries& entries) {
  const Size now = recent_.back();
  for (auto& entry : entries) {
    if (entry.state == State::kFree && entry.size == now) ++entry.idle;
  }
  release(entries, [](const auto& entry) { return entry.idle > kIdle; });
}

void Pool::begin(uint32_t width, uint32_t height) {
  const Size size = {width, height};
  recording_ = true;
  if (!recent_.empty() && recent_.back() == size) return;
  const auto found = std::ranges::find(recent_, size);
  if (found != recent_.end()) {
    std::rotate(found, found + 1, recent_.end());
    return;
  }
  recent_.push_back(size);
  if (recent_.size() <= size_t{keptSizes_} + 1) return;
  recent_.erase(recent_.begin());
  const auto forgotten = [&](const auto& entry) {
    return std::ranges::find(recent_, entry.size) == recent_.end();
  };
  release(textures_, forgotten);
  release(buffers_, forgotten);
}

void Pool::end() {
  if (!std::exchange(recording_, false)) return;
  finish(textures_);
  finish(buffers_);
  takeBack();
}

void Pool::takeBack() {
  for (auto& entry : textures_) {
    if (entry.state == State::kTransient) entry.state = State::kFree;
  }
}

gpu::Texture Pool::transient(const gpu::TextureDesc& desc) {
  return take(textures_, desc, State::kTransient, [this](const gpu::TextureDesc& wanted) {
    return ForwardingMaker::createTexture(wanted);
  });
}

void Pool::clear() {
  recording_ = false;
  takeBack();
  const auto all = [](const auto&) { return true; };
  release(textures_, all);
  release(buffers_, all);
  recent_.clear();
}

gpu::Buffer Pool::createBuffer(const gpu::BufferDesc& desc) {
  return take(buffers_, desc, State::kUsed, [this](const gpu::BufferDesc& wanted) {
    return ForwardingMaker::createBuffer(wanted);
  });
}

gpu::Texture Pool::createTexture(const gpu::TextureDesc& desc) {
  return take(textures_, desc, State::kUsed, [this](const gpu::TextureDesc& wanted) {
    return ForwardingMaker::createTexture(wanted);
  });
}

void Pool::destroy(gpu::Buffer buffer) {
  giveBack(buffers_, buffer);
}

void Pool::destroy(gpu::Texture texture) {
  giveBack(textures_, texture);
}

}  // namespace grisaille::host
