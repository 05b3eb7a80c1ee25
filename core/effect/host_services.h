// SPDX-License-Identifier: MIT
// The host's side of grisaille_host and grisaille_frame for one instance: it turns the C structs
// into the layer's, catches what the layer throws, and knows which resources are the effect's own.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "core/effect/instance.h"

namespace grisaille::effect {

class HostServices;

// The tables with all functions, for one instance; the frame's data is empty.
grisaille_host hostTable(HostServices* self);
grisaille_frame frameTable(HostServices* self);

class HostServices {
 public:
  // The effect's key is in labels.
  HostServices(gpu::Maker& device, const Effect& effect);
  HostServices(const HostServices&) = delete;
  HostServices& operator=(const HostServices&) = delete;

  // The table that the effect's create() gets; good until the end.
  const grisaille_host* table() const { return &host_; }

  // Around each of the effect's functions, which alone may ask for services. open() forgets the
  // faults of the call before; openFrame() also destroys what was destroyed during the frame
  // before.
  void open();
  const grisaille_frame* openFrame(const FrameInputs& inputs);
  void close();  // ends a pass that was left open, which is a fault

  // Why the call between open() and close() failed, in one line; "" when it did not.
  std::string failure(grisaille_result result) const;

  // By what number: the device's where its memory ran out or it was lost, which is no fault of the
  // effect's; else `otherwise`.
  ErrorId failureId(ErrorId otherwise) const { return deviceFault_.value_or(otherwise); }

  // What the effect counted in the last frame.
  uint64_t waiting() const { return waiting_; }

  // Destroys what the effect left.
  void destroyAll() noexcept;

 private:
  friend struct HostFunctions;  // the C functions

  template <typename Handle>
  struct Kind {
    std::unordered_set<uint32_t> own;  // the instance's; the C id is the handle's value
    std::vector<Handle> buried;        // destroyed during the frame that may use them still
  };

  void noteDeviceFault(ErrorId id) {
    const bool device = id == ErrorId::kOutOfDeviceMemory || id == ErrorId::kDeviceLost;
    if (device) deviceFault_ = id;
  }

  template <typename Handle>
  void destroyBuried(Kind<Handle>& kind);
  template <typename Handle>
  void destroyOwn(Kind<Handle>& kind) noexcept;

  // Kept from frame to frame, as all that recording fills: it allocates nothing then.
  const std::string& labelled(const char* label);

  gpu::Maker& device_;
  std::string key_;
  const bool takesObjects_;
  grisaille_host host_;
  bool inside_ = false;  // an effect's function runs

  Kind<gpu::Buffer> buffers_;
  Kind<gpu::Texture> textures_;
  Kind<gpu::Sampler> samplers_;
  Kind<gpu::ComputePipeline> pipelines_;

  // Of the frame being recorded.
  grisaille_frame frame_;
  grisaille_objects objects_ = {};
  Services offered_;
  uint64_t waiting_ = 0;
  gpu::Commands* commands_ = nullptr;
  bool passOpen_ = false;
  std::vector<grisaille_texture> attachments_;  // may be read
  std::vector<grisaille_texture> outputs_;
  std::vector<uint32_t> writable_;      // transients and outputs
  std::vector<uint32_t> uniforms_;      // buffers
  std::vector<gpu::Binding> bindings_;  // of a dispatch
  std::string label_;                   // of a pass or a transient texture
  uint64_t frames_ = 0;

  // Of the call since open().
  std::string ownWords_;  // the effect's
  std::string refused_;   // the first service that was refused, and why
  std::string misuse_;    // the first fault that no result could tell the effect of
  std::optional<ErrorId> deviceFault_;
};

}  // namespace grisaille::effect
