// SPDX-License-Identifier: MIT
// KHR_debug: the driver's messages as lines of the device's message sink.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::opengl {

// Turns the messages of the current context on, where it is a debug context: all but notifications
// when `check`, else errors alone. The sink must outlive the context.
void startDebugOutput(const gpu::MessageSink& sink, bool check);

// Takes the sink out of the current context.
void stopDebugOutput();

// Mutes the messages of calls whose failure is thrown as an Error.
class QuietDebugOutput {
 public:
  QuietDebugOutput();
  ~QuietDebugOutput();
  QuietDebugOutput(const QuietDebugOutput&) = delete;
  QuietDebugOutput& operator=(const QuietDebugOutput&) = delete;

 private:
  bool wasOn_;
};

}  // namespace grisaille::opengl
