// SPDX-License-Identifier: MIT
// The host's function that takes messages.
#pragma once

#include <string>
#include <string_view>

#include "core/gpu/device.h"
#include "grisaille/host.h"

namespace grisaille::host {

class Log {
 public:
  Log() = default;
  explicit Log(const grisaille_host_log& log) : log_(log) {}

  // Without a function, the message is lost.
  void write(grisaille_host_level level, std::string_view text) const noexcept {
    if (log_.write == nullptr) return;
    try {
      log_.write(log_.context, level, std::string(text).c_str());
    } catch (...) {
    }  // no memory for the copy: the message is lost
  }

  // For the checking device.
  gpu::MessageSink sink() const {
    return [log = *this](gpu::Severity severity, std::string_view text) {
      log.write(severity == gpu::Severity::kError     ? GRISAILLE_HOST_ERROR
                : severity == gpu::Severity::kWarning ? GRISAILLE_HOST_WARNING
                                                      : GRISAILLE_HOST_INFO,
                text);
    };
  }

 private:
  grisaille_host_log log_ = {};
};

}  // namespace grisaille::host
