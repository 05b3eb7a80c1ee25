// SPDX-License-Identifier: MIT
// An open device: its function table, queue, limits and memory. All parts of the backend share one
// Context by reference.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "backends/vulkan/instance.h"
#include "backends/vulkan/memory.h"
#include "backends/vulkan/surface.h"

namespace grisaille::vulkan {

class Context {
 public:
  explicit Context(const gpu::DeviceOptions& options);
  // Uses another program's device. The program destroys it after this object.
  explicit Context(const HostHandles& host);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Names an object for debuggers and validation messages. In another program, names begin with
  // "grisaille: ".
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
  const VkAllocationCallbacks* callbacks = nullptr;  // another program's; null: none
  Allocator memory;

 private:
  // A public constructor delegates to this one, so that the destructor runs when it throws.
  Context(bool check, const gpu::MessageSink& message, backends::Window* window);
  void open(const Candidate& chosen);
  void describe(const Candidate& chosen, MemorySource* source = nullptr);
  void setName(VkObjectType type, uint64_t object, std::string_view label) const;

  bool foreign_ = false;  // the device is another program's
  Instance instance_;
  std::optional<Surface> surface_;
  VkAllocationCallbacks foreignCallbacks_{};
};

}  // namespace grisaille::vulkan
