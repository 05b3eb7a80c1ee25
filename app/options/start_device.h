// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/gpu/device.h"

namespace grisaille::app {

// Starts a device of `backend`; "": of the first backend that starts. Throws as backends::create()
// does; for "", kNoDevice with the reason of every backend.
std::unique_ptr<gpu::Device> startDevice(const std::string& backend,
                                         const gpu::DeviceOptions& options);

// Starts and destroys a device of each backend, so that a missing device fails before slow work.
// Throws as backends::create() does.
void requireDevices(const std::vector<std::string>& backends, const std::string& device);

// The backends that "opengl", "vulkan" or "both" names. Throws as backends::find() does.
std::vector<std::string> chosenBackends(const std::string& text);

}  // namespace grisaille::app
