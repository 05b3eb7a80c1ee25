// SPDX-License-Identifier: MIT
// Entry points of the vulkan backend.
#pragma once

#include <memory>
#include <vector>

#include "core/gpu/host_device.h"

namespace grisaille::vulkan {

// The devices that --device chooses from, in the order of their numbers.
std::vector<gpu::ListedDevice> listDevices();

// Throws kBackendMissing, kNoDevice, kDeviceTooOld, kDeviceFailed.
std::unique_ptr<gpu::Device> createDevice(const gpu::DeviceOptions& options);

// Another program's Vulkan handles. `getInstanceProcAddr`, a PFN_vkGetInstanceProcAddr, is the
// entry point of the program's loader; null takes libvulkan.so.1. The loader of the first device
// serves the whole process.
struct HostHandles {
  void* instance = nullptr;
  void* physicalDevice = nullptr;
  void* device = nullptr;
  uint32_t queueFamily = 0;
  uint32_t framesInFlight = 0;  // at least 1
  void (*getInstanceProcAddr)() = nullptr;
  uint64_t pipelineCache = 0;  // a VkPipelineCache of the program; 0: none
};

// Throws kHostDevice, kBackendMissing, kDeviceTooOld, kDeviceFailed.
std::unique_ptr<gpu::HostDevice> createHostDevice(const HostHandles& handles);

}  // namespace grisaille::vulkan
