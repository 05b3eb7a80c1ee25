// SPDX-License-Identifier: MIT
// Prints the device of a command, and the messages of its driver and of the validation.
#pragma once

#include <fmt/format.h>

#include <cstdio>

#include "core/base/error.h"
#include "core/gpu/device.h"

namespace grisaille::app {

// Prints one line: backend, device and driver.
inline void printDevice(const gpu::DeviceInfo& info, std::FILE* file = stdout) {
  fmt::print(file, "{}: {} ({}){}\n", info.backend, info.name, info.driver,
             info.software ? ", software" : "");
  std::fflush(file);
}

class DriverMessages {
 public:
  // The sink prints to standard error and counts warnings and errors. It must not outlive this.
  gpu::MessageSink sink() {
    return [this](gpu::Severity severity, std::string_view text) {
      const bool info = severity == gpu::Severity::kInfo;
      if (!info) ++count_;
      fmt::print(stderr, "{}: {}\n", info ? "note" : "driver", text);
    };
  }

  // Throws kDriverMessages if the sink counted any message. Call it after the device is destroyed.
  void throwIfAny() const {
    if (count_ == 0) return;
    throw Error(ErrorId::kDriverMessages, "the driver or its validation printed {} messages",
                count_);
  }

 private:
  size_t count_ = 0;
};

}  // namespace grisaille::app
