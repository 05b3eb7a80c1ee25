// SPDX-License-Identifier: MIT
// KHR_debug: passes the driver's messages to the device's message sink.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::opengl {

// Turns on the messages of the current context if it is a debug context. With `check`, the sink
// receives all messages except notifications, else only errors. It must outlive the context.
void startDebugOutput(const gpu::MessageSink& sink, bool check);

// Detaches the sink from the current context.
void stopDebugOutput();

// Mutes the driver's messages while it lives: for calls that report failure as an Error.
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
