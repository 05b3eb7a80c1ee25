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

struct HostSpec {
  // Frames by which the GPU may be behind without an allocation, at least 1.
  uint32_t framesInFlight = 3;
  bool keepsState = false;  // the program restores the context's state itself
};

// Creates a device in another program's context, which must be current. Throws kHostContext,
// kDeviceTooOld.
std::unique_ptr<gpu::HostDevice> createHostDevice(const HostSpec& spec);

}  // namespace grisaille::opengl
