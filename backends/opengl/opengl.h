// SPDX-License-Identifier: MIT
// The opengl backend: what backends/backends.cpp needs of it.
#pragma once

#include <memory>
#include <vector>

#include "core/gpu/host_device.h"

namespace grisaille::opengl {

// The devices that --device chooses from, in the order of their numbers.
std::vector<gpu::ListedDevice> listDevices();

// Throws kBackendMissing, kNoDevice, kDeviceTooOld, kDeviceFailed.
std::unique_ptr<gpu::Device> createDevice(const gpu::DeviceOptions& options);

// In the context that is current, another program's. Throws kHostContext, kDeviceTooOld.
std::unique_ptr<gpu::HostDevice> createHostDevice();

}  // namespace grisaille::opengl
