// SPDX-License-Identifier: MIT
#include "core/gpu/transient_pool.h"

namespace grisaille::gpu {
namespace {

bool alike(const TextureDesc& a, const TextureDesc& b) {
  return a.format == b.format && a.width == b.width && a.height == b.height && a.mips == b.mips &&
         a.layers == b.layers && a.usage == b.usage;
}

}  // namespace

Texture TransientPool::take(const TextureDesc& desc, const Create& create) {
  for (Entry& entry : entries_) {
    if (!entry.taken && alike(entry.desc, desc)) {
      entry.taken = true;
      entry.idle = 0;
      return entry.texture;
    }
  }
  Entry entry{.desc = desc, .texture = create(desc), .idle = 0, .taken = true};
  entry.desc.label = {};
  entries_.push_back(entry);
  return entry.texture;
}

void TransientPool::endFrame(const Destroy& destroy) {
  for (Entry& entry : entries_) {
    if (!entry.taken) ++entry.idle;
    entry.taken = false;
    if (entry.idle > kIdleFrames) destroy(entry.texture);
  }
  std::erase_if(entries_, [](const Entry& entry) { return entry.idle > kIdleFrames; });
}

void TransientPool::clear(const Destroy& destroy) {
  for (const Entry& entry : entries_) destroy(entry.texture);
  entries_.clear();
}

}  // namespace grisaille::gpu
