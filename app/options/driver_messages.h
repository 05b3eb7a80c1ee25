// SPDX-License-Identifier: MIT
// Which device a command runs on, and what its driver or the validation says meanwhile.
#pragma once

#include <fmt/format.h>

#include <cstdio>

#include "core/base/error.h"
#include "core/gpu/device.h"

namespace grisaille::app {

// The line by which a command says which device it took.
inline void printDevice(const gpu::DeviceInfo& info, std::FILE* file = stdout) {
  fmt::print(file, "{}: {} ({}){}\n", info.backend, info.name, info.driver,
             info.software ? ", software" : "");
  std::fflush(file);
}

class DriverMessages {
 public:
  // Prints to standard error and counts; outlived by this.
  gpu::MessageSink sink() {
    return [this](gpu::Severity severity, std::string_view text) {
      const bool info = severity == gpu::Severity::kInfo;
      if (!info) ++count_;
      fmt::print(stderr, "{}: {}\n", info ? "note" : "driver", text);
    };
  }

  // Throws kDriverMessages: a command that was to check must cause none. Once the device is gone.
  void throwIfAny() const {
    if (count_ == 0) return;
    throw Error(ErrorId::kDriverMessages, "{} messages of the driver or its validation", count_);
  }

 private:
  size_t count_ = 0;
};

}  // namespace grisaille::app
