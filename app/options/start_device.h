// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/gpu/device.h"

namespace grisaille::app {

// A device of the backend asked for or, where `backend` is "", of the first one that starts. Throws
// as backends::create() does, and kNoDevice with every backend's reason.
std::unique_ptr<gpu::Device> startDevice(const std::string& backend,
                                         const gpu::DeviceOptions& options);

// Starts a device of each backend and lets go of it: what is missing says so before work that takes
// long. Throws as backends::create() does.
void requireDevices(const std::vector<std::string>& backends, const std::string& device);

// The backends that "opengl", "vulkan" or "both" names. Throws as backends::find() does.
std::vector<std::string> chosenBackends(const std::string& text);

}  // namespace grisaille::app
