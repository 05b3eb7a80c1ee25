// SPDX-License-Identifier: MIT
#include "app/options/start_device.h"

#include "backends/backends.h"
#include "core/base/error.h"

namespace grisaille::app {

std::unique_ptr<gpu::Device> startDevice(const std::string& backend,
                                         const gpu::DeviceOptions& options) {
  if (!backend.empty()) return backends::create(backend, options);
  std::string reasons;
  for (const backends::Backend& one : backends::all()) {
    try {
      return backends::create(one.name, options);
    } catch (const Error& error) {
      reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", one.name, error.detail());
    }
  }
  throw Error(ErrorId::kNoDevice, "no backend starts: {}", reasons);
}

void requireDevices(const std::vector<std::string>& backends, const std::string& device) {
  for (const std::string& name : backends) backends::create(name, {.device = device});
}

std::vector<std::string> chosenBackends(const std::string& text) {
  if (text == "both") return {"opengl", "vulkan"};
  backends::find(text);
  return {text};
}

}  // namespace grisaille::app
