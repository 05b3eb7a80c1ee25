// SPDX-License-Identifier: MIT
// The host's side of grisaille_host and grisaille_frame for one instance: it converts the C structs
// to the GPU layer's, catches the layer's exceptions, and tracks the resources that the effect
// owns.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/effect/instance.h"

namespace grisaille::effect {

class HostServices;

// The function tables for one instance; the frame's data members are empty.
grisaille_host hostTable(HostServices* self);
grisaille_frame frameTable(HostServices* self);

class HostServices {
 public:
  // Labels of passes and resources begin with the effect's key.
  HostServices(gpu::Maker& device, const Effect& effect);
  HostServices(const HostServices&) = delete;
  HostServices& operator=(const HostServices&) = delete;

  // The table that the effect's create() gets; valid while this lives.
  const grisaille_host* table() const { return &host_; }

  // Call open(), openFrame() or openPoints() before each of the effect's functions, and close()
  // after it: only these functions may call services. open() forgets the faults of the previous
  // call. openFrame() also frees the resources that the effect destroyed during the previous frame.
  void open();
  const grisaille_frame* openFrame(const FrameInputs& inputs);
  const grisaille_points* openPoints(const PointInputs& inputs);
  void close();  // also ends a pass that the effect left open, which is a fault

  // The reason why the call between open() and close() failed, in one line; "" if it succeeded.
  std::string failure(grisaille_result result) const;

  // The number of that error: the device's if it ran out of memory or was lost, which is not the
  // effect's fault; else `otherwise`.
  ErrorId failureId(ErrorId otherwise) const { return deviceFault_.value_or(otherwise); }

  // Number of resources that the effect has made and not destroyed.
  size_t resources() const {
    return buffers_.own.size() + textures_.own.size() + samplers_.own.size() +
           pipelines_.own.size();
  }

  // What the effect reported in the last frame.
  const Report& report() const { return report_; }

  // Destroys the resources that the effect has not destroyed.
  void destroyAll() noexcept;

 private:
  friend struct HostFunctions;  // the C functions

  template <typename Handle>
  struct Kind {
    // Vectors: a frame that makes and destroys as many as the one before allocates nothing.
    std::vector<uint32_t> own;   // the instance owns these; the C id is the handle's value
    std::vector<Handle> buried;  // to free after the frame, which may still use them
    std::vector<Handle> freed;   // by destroyBuried(), which may throw
  };

  void noteDeviceFault(ErrorId id) {
    const bool device = id == ErrorId::kOutOfDeviceMemory || id == ErrorId::kDeviceLost;
    if (device) deviceFault_ = id;
  }

  template <typename Handle>
  void destroyBuried(Kind<Handle>& kind);
  template <typename Handle>
  void destroyOwn(Kind<Handle>& kind) noexcept;

  // Sets objects_ and returns it; null if the effect takes no objects.
  const grisaille_objects* give(const objects::View& objects, size_t kept);

  // Returns label_. Recording reuses its containers between frames and allocates no memory.
  const std::string& labelled(const char* label);

  gpu::Maker& device_;
  std::string key_;
  const bool takesObjects_;
  grisaille_host host_;
  bool inside_ = false;  // one of the effect's functions runs

  Kind<gpu::Buffer> buffers_;
  Kind<gpu::Texture> textures_;
  Kind<gpu::Sampler> samplers_;
  Kind<gpu::ComputePipeline> pipelines_;

  // State of the frame that is being recorded, or of the points.
  grisaille_frame frame_;
  grisaille_points points_ = {};
  bool casts_ = false;  // record() or draw_at() runs
  grisaille_objects objects_ = {};
  Services offered_;
  Report report_;
  gpu::Commands* commands_ = nullptr;
  bool passOpen_ = false;
  std::vector<grisaille_texture> attachments_;  // the effect may read these, and those of inputs_
  std::vector<grisaille_texture> inputs_;
  std::vector<grisaille_texture> outputs_;
  std::vector<uint32_t> writable_;      // transients and outputs
  std::vector<uint32_t> uniforms_;      // buffers
  std::vector<gpu::Binding> bindings_;  // of a dispatch
  std::string label_;                   // the last that labelled() built
  uint64_t frames_ = 0;

  // State of the call since open().
  std::string ownWords_;  // the effect's message
  std::string refused_;   // the first service that failed, and why
  std::string misuse_;    // the first fault that no result could report to the effect
  std::optional<ErrorId> deviceFault_;
};

}  // namespace grisaille::effect
