// SPDX-License-Identifier: MIT
// The Vulkan loader, an instance, its messages, and the choice of a physical device.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "backends/vulkan/api.h"
#include "backends/vulkan/vulkan.h"
#include "core/gpu/device.h"

namespace grisaille::vulkan {

// VK_EXT_debug_utils; null where the extension is not there.
struct DebugFunctions {
  PFN_vkSetDebugUtilsObjectNameEXT setName = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;
};

// VK_KHR_surface; null unless it is one of the instance's extensions. Not volk's globals, which are
// of the process's first instance.
struct SurfaceFunctions {
  PFN_vkDestroySurfaceKHR destroy = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceSupportKHR support = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR capabilities = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceFormatsKHR formats = nullptr;
};

class Instance {
 public:
  // With `check`, the validation layer's messages go to `message`. `extensions` are enabled besides
  // the instance's own. Throws kBackendMissing, kDeviceTooOld.
  Instance(bool check, gpu::MessageSink message, std::span<const char* const> extensions = {});
  // Another program's, which it destroys after this.
  explicit Instance(const HostHandles& host);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return instance_; }
  const DebugFunctions& debug() const { return debug_; }
  const SurfaceFunctions& surface() const { return surface_; }

  // In the loader's order.
  std::vector<VkPhysicalDevice> devices() const;

 private:
  // Delegated to, so that the destructor runs when the public constructor throws.
  explicit Instance(gpu::MessageSink message);
  void create(bool debugUtils, bool validate, std::span<const char* const> others);
  void load(bool debugUtils);
  void createMessenger();

  gpu::MessageSink message_;
  VkInstance instance_ = VK_NULL_HANDLE;
  bool foreign_ = false;
  DebugFunctions debug_;
  SurfaceFunctions surface_;
  PFN_vkDestroyDebugUtilsMessengerEXT destroyMessenger_ = nullptr;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

// A physical device and what the backend needs to know to open it.
struct Candidate {
  VkPhysicalDevice device = VK_NULL_HANDLE;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  gpu::ListedDevice listed;
  std::string lacks;         // what the backend requires and this device has not; "" when it fits
  uint32_t queueFamily = 0;  // draws and computes
  uint32_t timestampBits = 0;
};

// With a surface, the queue must show pictures there.
std::vector<Candidate> candidates(const Instance& instance, VkSurfaceKHR surface = VK_NULL_HANDLE);

// `wanted` as DeviceOptions::device. Throws kNoDevice, kDeviceTooOld.
const Candidate& choose(const std::vector<Candidate>& candidates, const std::string& wanted);

// Of a device that another program has opened, with this queue family. Throws kHostDevice.
Candidate foreignCandidate(VkPhysicalDevice device, uint32_t queueFamily);

VkFormat vulkanFormat(gpu::Format format);

}  // namespace grisaille::vulkan
