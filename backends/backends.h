// SPDX-License-Identifier: MIT
// Every backend of this program, by name.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/gpu/device.h"

namespace grisaille::backends {

struct Backend {
  const char* name;   // "opengl", "vulkan"
  const char* label;  // "OpenGL", "Vulkan": for titles
  // Both throw kBackendMissing where the driver library is not there.
  std::vector<gpu::ListedDevice> (*list)();
  std::unique_ptr<gpu::Device> (*create)(const gpu::DeviceOptions& options);
};

std::span<const Backend> all();

// Throws kBackendUnknown.
const Backend& find(std::string_view name);

// A device of the named backend, inside the checking device when options.check (or in a debug
// build).
std::unique_ptr<gpu::Device> create(std::string_view name, const gpu::DeviceOptions& options);

}  // namespace grisaille::backends
