// SPDX-License-Identifier: MIT
// The backends of this program, by name.
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
  // Both throw kBackendMissing if the driver library is not installed.
  std::vector<gpu::ListedDevice> (*list)();
  std::unique_ptr<gpu::Device> (*create)(const gpu::DeviceOptions& options);
};

std::span<const Backend> all();

// Throws kBackendUnknown.
const Backend& find(std::string_view name);

// Creates a device of the named backend. With options.check, and in every debug build, the device
// is wrapped in the checking device. Throws kBackendUnknown, and what Backend::create throws.
std::unique_ptr<gpu::Device> create(std::string_view name, const gpu::DeviceOptions& options);

}  // namespace grisaille::backends
