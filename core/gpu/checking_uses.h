// SPDX-License-Identifier: MIT
// What one dispatch or render call reads and writes, for the checking device: collected from its
// bindings, targets, streams and indices, then checked against the account and each other.
#pragma once

#include <vector>

#include "core/gpu/checking_records.h"

namespace grisaille::gpu {

class CallUses {
 public:
  explicit CallUses(Account& account) : account_(account) {}

  // Throw kBindingMissing ... kBindingFormat, kBufferUsage, kTextureUsage, kStaleHandle,
  // kTransientStale.
  void addBindings(PipelineRecord& pipeline, std::span<const Binding> bindings);
  // One subresource that was found valid, as a target. `what` is for messages, and stays
  // valid: "colour target".
  void addTarget(const TextureView& view, bool loads, const char* what);
  // A range of a buffer that was found valid and has a size, for vertices or indices. `what` is for
  // messages, and stays valid.
  void addRead(const BufferRange& range, const char* what);

  // Throws kUninitialised and kHazard.
  void check() const;

  // After the call was passed on: notes what is written now, and used by this frame.
  void commit();

 private:
  struct Use {
    Buffer buffer = {};
    Texture texture = {};
    uint64_t begin = 0, end = 0;       // bytes; of a texture: mip levels
    uint32_t layer = 0, layerEnd = 0;  // of a texture
    bool reads = false, writes = false;
    bool target = false;
    const char* what = "";  // the slot's name, or the role
  };

  void addBinding(const PipelineRecord& pipeline, const grisaille_shader_slot& slot,
                  const Binding& binding);
  void addBuffer(const grisaille_shader_slot& slot, const BufferRange& range);
  void addView(const grisaille_shader_slot& slot, const Binding& binding);
  BufferRange resolved(const grisaille_shader_slot& slot, const BufferRange& range);
  void checkWritten(const Use& use) const;
  std::string nameOf(const Use& use) const;
  static bool overlap(const Use& a, const Use& b);

  Account& account_;
  std::vector<Use> uses_;
  std::vector<uint64_t*> marks_;  // the used frames of the records
};

// The view with its counts resolved. Throws kBindingRange.
TextureView resolvedView(const TextureView& view, const TextureRecord& texture, const char* what);

}  // namespace grisaille::gpu
