// SPDX-License-Identifier: MIT
// An open device: its function table, queue, limits and memory. All parts of the backend share one
// Context by reference.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "backends/vulkan/instance.h"
#include "backends/vulkan/surface.h"

namespace grisaille::vulkan {

// The kind of memory to allocate.
enum class MemoryKind {
  kDevice,    // device-local
  kUpload,    // mapped, written by the host
  kReadback,  // mapped, read by the host; cached if the device has a cached type
};

class Context {
 public:
  explicit Context(const gpu::DeviceOptions& options);
  // Uses another program's device. The program destroys it after this object.
  explicit Context(const HostHandles& host);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Throws kOutOfDeviceMemory, kTooManyResources.
  VkDeviceMemory allocate(const VkMemoryRequirements& requirements, MemoryKind kind);
  void free(VkDeviceMemory memory);

  // Names an object for debuggers and validation messages.
  template <typename Object>
  void name(VkObjectType type, Object object, std::string_view label) const {
    if (debug().setName != nullptr && !label.empty()) {
      setName(type, reinterpret_cast<uint64_t>(object), label);
    }
  }
  const DebugFunctions& debug() const { return instance_.debug(); }

  // The window's surface; null without a window.
  Surface* surface() { return surface_ ? &*surface_ : nullptr; }

  VolkDeviceTable vk{};
  VkDevice device = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;
  uint32_t timestampBits = 0;  // valid bits of the queue's timestamps; 0: it has none
  VkPhysicalDeviceProperties properties{};
  gpu::DeviceInfo info;

 private:
  // A public constructor delegates to this one, so that the destructor runs when it throws.
  Context(bool check, const gpu::MessageSink& message, backends::Window* window);
  void open(const Candidate& chosen);
  void describe(const Candidate& chosen);
  void setName(VkObjectType type, uint64_t object, std::string_view label) const;

  bool foreign_ = false;  // the device is another program's
  Instance instance_;
  std::optional<Surface> surface_;
  VkPhysicalDeviceMemoryProperties memory_{};
  uint64_t maxAllocationBytes_ = 0;
  uint32_t allocations_ = 0;
};

}  // namespace grisaille::vulkan
