// SPDX-License-Identifier: MIT
// A device without a driver, for tests of the code above the GPU layer. It stores uploads, records
// every command, and draws and computes nothing.
#pragma once

#include <variant>

#include "core/gpu/device.h"
#include "core/gpu/state_tracker.h"

namespace grisaille::gpu {

// The recorded commands.
struct RecordedPass {
  std::string label;
  bool begins = true;
};
struct RecordedBarriers {
  std::vector<Transition> transitions;
};
struct RecordedDispatch {
  std::string pipeline;
  std::array<uint32_t, 3> groups;
  std::vector<Binding> bindings;
};
struct RecordedRender {
  size_t draws = 0;
  std::vector<std::string> targets;
  bool depth = false;
};
struct RecordedUpload {
  std::string resource;
  size_t bytes = 0;
};
using Recorded =
    std::variant<RecordedPass, RecordedBarriers, RecordedDispatch, RecordedRender, RecordedUpload>;

class NullDevice : public Device {
 public:
  // All commands since the last begin(), in order.
  virtual const std::vector<Recorded>& recorded() const = 0;
};

std::unique_ptr<NullDevice> makeNullDevice();

}  // namespace grisaille::gpu
