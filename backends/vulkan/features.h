// SPDX-License-Identifier: MIT
// The device features that the backend uses.
#pragma once

#include <string>

#include "backends/vulkan/api.h"

namespace grisaille::vulkan {

// The structures of Vulkan 1.0, 1.2 and 1.3, linked.
struct FeatureChain {
  FeatureChain() {
    v10.pNext = &v12;
    v12.pNext = &v13;
  }
  FeatureChain(const FeatureChain&) = delete;
  FeatureChain& operator=(const FeatureChain&) = delete;

  VkPhysicalDeviceFeatures2 v10{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
};

// The first required feature that a device of Vulkan 1.3 has not, or "".
std::string lackingFeature(VkPhysicalDevice device);

// The same of what effects alone require, which draw and submit nothing.
std::string lackingForEffects(VkPhysicalDevice device);

// Sets what the backend uses: all that is required, and anisotropic filtering where it is there.
void enableFeatures(VkPhysicalDevice device, FeatureChain& chain);

}  // namespace grisaille::vulkan
