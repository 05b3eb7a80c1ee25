// SPDX-License-Identifier: MIT
// The reads and writes of one dispatch or render call, for the checking device. CallUses collects
// them from bindings, targets, vertex streams and indices, then checks them against the records and
// against each other.
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
  // Adds one valid subresource as a target. `loads`: the target keeps its earlier contents. `what`
  // is for messages ("colour target") and must outlive this object.
  void addTarget(const TextureView& view, bool loads, const char* what);
  // Adds a valid range of a buffer, with a size other than 0, for vertices or indices. `what` is
  // for messages and must outlive this object.
  void addRead(const BufferRange& range, const char* what);

  // Throws kUninitialised and kHazard.
  void check() const;

  // Call after the call was forwarded: marks its writes, and its resources as used by this frame.
  void commit();

 private:
  struct Use {
    Buffer buffer = {};
    Texture texture = {};
    uint64_t begin = 0, end = 0;       // buffers: bytes; textures: mip levels
    uint32_t layer = 0, layerEnd = 0;  // textures only
    bool reads = false, writes = false;
    bool target = false;
    const char* what = "";  // name of the slot, or role: "colour target"
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
  std::vector<uint64_t*> marks_;  // usedFrame of each used record
};

// Returns the view with counts of 0 resolved. `what` is for messages. Throws kBindingRange.
TextureView resolvedView(const TextureView& view, const TextureRecord& texture, const char* what);

}  // namespace grisaille::gpu
