// SPDX-License-Identifier: MIT
// Entry points of the opengl backend.
#pragma once

#include <memory>
#include <vector>

#include "core/gpu/host_device.h"

namespace grisaille::opengl {

// The devices that --device chooses from, in the order of their numbers.
std::vector<gpu::ListedDevice> listDevices();

// Throws kBackendMissing, kNoDevice, kDeviceTooOld, kDeviceFailed.
std::unique_ptr<gpu::Device> createDevice(const gpu::DeviceOptions& options);

// Creates a device in another program's context, which must be current. Throws kHostContext,
// kDeviceTooOld.
std::unique_ptr<gpu::HostDevice> createHostDevice();

}  // namespace grisaille::opengl
