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

// VK_EXT_debug_utils; null if the extension is not available.
struct DebugFunctions {
  PFN_vkSetDebugUtilsObjectNameEXT setName = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;
};

// VK_KHR_surface; null unless the instance enables it. Loaded for each instance: volk's globals
// belong to the process's first instance.
struct SurfaceFunctions {
  PFN_vkDestroySurfaceKHR destroy = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceSupportKHR support = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR capabilities = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceFormatsKHR formats = nullptr;
};

class Instance {
 public:
  // With `check`, the validation layer's messages go to `message`. `extensions`: instance
  // extensions to enable in addition. Throws kBackendMissing, kDeviceTooOld.
  Instance(bool check, gpu::MessageSink message, std::span<const char* const> extensions = {});
  // Uses another program's instance. The program destroys it after this object.
  explicit Instance(const HostHandles& host);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return instance_; }
  const DebugFunctions& debug() const { return debug_; }
  const SurfaceFunctions& surface() const { return surface_; }

  // The physical devices, in the loader's order.
  std::vector<VkPhysicalDevice> devices() const;

 private:
  // The public constructor delegates to this one, so that the destructor runs when it throws.
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

// A physical device, and the properties needed to choose and open it.
struct Candidate {
  VkPhysicalDevice device = VK_NULL_HANDLE;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  gpu::ListedDevice listed;
  std::string lacks;         // the first requirement that the device does not meet; "": it fits
  uint32_t queueFamily = 0;  // supports graphics and compute
  uint32_t timestampBits = 0;
};

// Lists all physical devices. With a surface, the queue must be able to present to it.
std::vector<Candidate> candidates(const Instance& instance, VkSurfaceKHR surface = VK_NULL_HANDLE);

// `wanted`: same as DeviceOptions::device. Throws kNoDevice, kDeviceTooOld.
const Candidate& choose(const std::vector<Candidate>& candidates, const std::string& wanted);

// Describes a device that another program opened with this queue family. Throws kHostDevice if it
// does not meet a requirement of effects.
Candidate foreignCandidate(VkPhysicalDevice device, uint32_t queueFamily);

VkFormat vulkanFormat(gpu::Format format);

}  // namespace grisaille::vulkan
