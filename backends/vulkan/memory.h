// SPDX-License-Identifier: MIT
// Device memory for buffers and images: one allocation for each, from the driver or from another
// program's functions.
#pragma once

#include <memory>
#include <string_view>

#include "backends/vulkan/api.h"
#include "backends/vulkan/vulkan.h"
#include "core/gpu/host_device.h"

namespace grisaille::vulkan {

// The kind of memory to allocate.
enum class MemoryKind {
  kDevice,    // device-local
  kUpload,    // mapped, written by the host
  kReadback,  // mapped, read by the host; cached if the device has a cached type
};

// Memory of one buffer or image.
struct Memory {
  ForeignMemory where;  // null: none
  uint64_t size = 0;    // bytes
  MemoryKind kind = MemoryKind::kDevice;
};

// A buffer or an image that needs memory.
struct Needing {
  VkMemoryRequirements requirements{};
  VkBuffer buffer = VK_NULL_HANDLE;
  VkImage image = VK_NULL_HANDLE;
  std::string_view label;
};

class Allocator {
 public:
  // The properties of an open device.
  struct Device {
    const VolkDeviceTable* vk = nullptr;
    VkDevice device = VK_NULL_HANDLE;
    const VkAllocationCallbacks* callbacks = nullptr;
    VkPhysicalDeviceMemoryProperties memory{};
    uint64_t maxBytes = 0;        // of one allocation
    uint32_t maxAllocations = 0;  // at a time
    std::string name;             // for messages
  };

  // `source`: allocates instead of the driver, and must outlive this; null: none.
  void open(Device device, MemorySource* source);

  // Mapped unless `kind` is kDevice. Throws kOutOfDeviceMemory, kTooManyResources, kDeviceFailed,
  // and kHostValue if another program's function returns memory that does not fit.
  Memory allocate(const Needing& needing, MemoryKind kind);
  void free(const Memory& memory);

  // Bytes that are allocated at present.
  const gpu::MemoryUse& use() const { return use_; }

 private:
  ForeignMemory ofDriver(const VkMemoryRequirements& requirements, MemoryKind kind);
  ForeignMemory ofSource(const Needing& needing, MemoryKind kind);

  Device device_;
  MemorySource* source_ = nullptr;
  gpu::MemoryUse use_;
};

}  // namespace grisaille::vulkan
