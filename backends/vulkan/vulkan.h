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

// Memory that another program allocates. See grisaille_host_memory_request and
// grisaille_host_memory, which have the same fields.
struct ForeignMemoryRequest {
  uint64_t size = 0;  // bytes
  uint64_t alignment = 1;
  uint32_t typeBits = 0;           // bit n: memory type n fits
  uint32_t requiredFlags = 0;      // VkMemoryPropertyFlags
  uint32_t preferredFlags = 0;     // VkMemoryPropertyFlags
  uint64_t buffer = 0, image = 0;  // VkBuffer or VkImage, the other is 0
  const char* label = "";
};
struct ForeignMemory {
  uint64_t memory = 0;  // VkDeviceMemory
  uint64_t offset = 0;  // bytes
  void* mapped = nullptr;
  void* handle = nullptr;  // the program's own
};
class MemorySource {
 public:
  virtual ~MemorySource() = default;

  // Returns a VkResult.
  virtual int allocate(const ForeignMemoryRequest& request, ForeignMemory& out) = 0;
  virtual void release(const ForeignMemory& memory) = 0;
};

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
  uint64_t pipelineCache = 0;       // a VkPipelineCache of the program; 0: none
  const void* callbacks = nullptr;  // VkAllocationCallbacks, which the device copies; null: none
  MemorySource* memory = nullptr;   // must outlive the device; null: the driver allocates
};

// Throws kHostDevice, kBackendMissing, kDeviceTooOld, kDeviceFailed.
std::unique_ptr<gpu::HostDevice> createHostDevice(const HostHandles& handles);

}  // namespace grisaille::vulkan
