// SPDX-License-Identifier: MIT
// What a driver or its validation says while a command runs.
#pragma once

#include <fmt/format.h>

#include <cstdio>

#include "core/error.h"
#include "core/gpu/device.h"

namespace grisaille::app {

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
