// SPDX-License-Identifier: MIT
// The vulkan backend: what backends/backends.cpp needs of it.
#pragma once

#include <memory>
#include <vector>

#include "core/gpu/host_device.h"

namespace grisaille::vulkan {

// The devices that --device chooses from, in the order of their numbers.
std::vector<gpu::ListedDevice> listDevices();

// Throws kBackendMissing, kNoDevice, kDeviceTooOld, kDeviceFailed.
std::unique_ptr<gpu::Device> createDevice(const gpu::DeviceOptions& options);

// What another program has: handles of the API, and its own loader's entry, a
// PFN_vkGetInstanceProcAddr, or null for libvulkan.so.1's. The first device's loader is this
// process's.
struct HostHandles {
  void* instance = nullptr;
  void* physicalDevice = nullptr;
  void* device = nullptr;
  uint32_t queueFamily = 0;
  uint32_t framesInFlight = 0;  // over 0
  void (*getInstanceProcAddr)() = nullptr;
};

// Throws kHostDevice, kBackendMissing, kDeviceTooOld, kDeviceFailed.
std::unique_ptr<gpu::HostDevice> createHostDevice(const HostHandles& handles);

}  // namespace grisaille::vulkan
