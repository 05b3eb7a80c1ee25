// SPDX-License-Identifier: MIT
#include "backends/vulkan/context.h"

#include <algorithm>

#include "backends/vulkan/features.h"

namespace grisaille::vulkan {

Context::Context(bool check, const gpu::MessageSink& message, backends::Window* window)
    : instance_(check, message,
                window == nullptr ? std::span<const char* const>() : surfaceExtensions(*window)) {
  if (window != nullptr) surface_.emplace(instance_, window);
}

Context::Context(const gpu::DeviceOptions& options)
    : Context(options.check, options.message, options.window) {
  const std::vector<Candidate> list =
      candidates(instance_, surface_ ? surface_->handle() : VK_NULL_HANDLE);
  const Candidate& chosen = choose(list, options.device);
  open(chosen);
  describe(chosen);
}

Context::Context(const HostHandles& host)
    : device(static_cast<VkDevice>(host.device)),
      physical(static_cast<VkPhysicalDevice>(host.physicalDevice)),
      queueFamily(host.queueFamily),
      foreign_(true),
      instance_(host) {
  volkLoadDeviceTable(&vk, device);
  if (host.callbacks != nullptr) {
    foreignCallbacks_ = *static_cast<const VkAllocationCallbacks*>(host.callbacks);
    callbacks = &foreignCallbacks_;
  }
  describe(foreignCandidate(physical, queueFamily), host.memory);
}

Context::~Context() {
  if (device != VK_NULL_HANDLE && !foreign_) vk.vkDestroyDevice(device, nullptr);
}

void Context::open(const Candidate& chosen) {
  physical = chosen.device;
  queueFamily = chosen.queueFamily;
  timestampBits = chosen.timestampBits;
  const float priority = 1;
  VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queues.queueFamilyIndex = queueFamily;
  queues.queueCount = 1;
  queues.pQueuePriorities = &priority;
  FeatureChain features;
  enableFeatures(physical, features);
  VkDeviceCreateInfo create{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features.v10};
  create.queueCreateInfoCount = 1;
  create.pQueueCreateInfos = &queues;
  const char* const extensions[] = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  create.enabledExtensionCount = surface_ ? 1 : 0;
  create.ppEnabledExtensionNames = extensions;
  check(vkCreateDevice(physical, &create, nullptr, &device), "vkCreateDevice");
  volkLoadDeviceTable(&vk, device);
  vk.vkGetDeviceQueue(device, queueFamily, 0, &queue);
}

void Context::describe(const Candidate& chosen, MemorySource* source) {
  VkPhysicalDeviceMaintenance4Properties maintenance4{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
  VkPhysicalDeviceMaintenance3Properties maintenance3{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES, &maintenance4};
  VkPhysicalDeviceProperties2 all{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &maintenance3, {}};
  vkGetPhysicalDeviceProperties2(physical, &all);
  properties = all.properties;

  info.backend = "vulkan";
  info.name = chosen.listed.name;
  info.driver = chosen.listed.driver;
  info.software = chosen.listed.software;
  const gpu::Clock stamps = timestampBits == 0 ? gpu::Clock::kNone : gpu::Clock::kGpu;
  info.clock = info.software ? gpu::Clock::kWall : stamps;

  const VkPhysicalDeviceLimits& limits = properties.limits;
  gpu::Capabilities& able = info.capabilities;
  able.maxTextureSize =
      std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight,
                limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]});
  able.maxTextureLayers = limits.maxImageArrayLayers;
  able.maxBufferBytes = std::min(maintenance4.maxBufferSize, maintenance3.maxMemoryAllocationSize);
  able.maxStorageRange = limits.maxStorageBufferRange;
  able.maxUniformRange = limits.maxUniformBufferRange;
  able.uniformAlignment = static_cast<uint32_t>(limits.minUniformBufferOffsetAlignment);
  able.storageAlignment = static_cast<uint32_t>(limits.minStorageBufferOffsetAlignment);
  std::copy_n(limits.maxComputeWorkGroupCount, 3, able.maxGroups.begin());
  FeatureChain enabled;
  enableFeatures(physical, enabled);
  able.maxAnisotropy =
      enabled.v10.features.samplerAnisotropy != 0 ? limits.maxSamplerAnisotropy : 1;

  Allocator::Device of = {.vk = &vk,
                          .device = device,
                          .callbacks = callbacks,
                          .maxBytes = maintenance3.maxMemoryAllocationSize,
                          .maxAllocations = limits.maxMemoryAllocationCount,
                          .name = info.name};
  vkGetPhysicalDeviceMemoryProperties(physical, &of.memory);
  memory.open(std::move(of), source);
}

void Context::setName(VkObjectType type, uint64_t object, std::string_view label) const {
  const std::string text = fmt::format("{}{}", foreign_ ? "grisaille: " : "", label);
  VkDebugUtilsObjectNameInfoEXT named{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
  named.objectType = type;
  named.objectHandle = object;
  named.pObjectName = text.c_str();
  debug().setName(device, &named);
}

}  // namespace grisaille::vulkan
