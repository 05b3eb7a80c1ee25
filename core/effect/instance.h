// SPDX-License-Identifier: MIT
// One effect at work on one device.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "core/effect/registry.h"
#include "core/gpu/device.h"

namespace grisaille::effect {

// kNone for a number that names no format.
gpu::Format formatOf(uint32_t format);

// What one record() works on. Everything is valid during the call.
struct FrameInputs {
  gpu::Commands* commands = nullptr;
  uint32_t width = 0;
  uint32_t height = 0;
  const grisaille_view* view = nullptr;
  gpu::BufferRange viewBlock;
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT> attachments;
  std::span<const gpu::Texture> outputs;  // one an output; null where nobody wants it
  std::span<const double> values;
};

class Instance {
 public:
  // Throws kEffectCreate with the effect's own words.
  Instance(gpu::Device& device, const Effect& effect);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  // Records the effect's passes, labelled "<effect key>/<pass>". Throws kEffectRecord with the
  // effect's own words and the layer's error that made it fail, by its number; the frame is then to
  // be abandoned. At most once between the device's begin() and submit(): what the effect destroys
  // meanwhile is kept until the next call, since this frame may use it.
  void record(const FrameInputs& inputs);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace grisaille::effect
