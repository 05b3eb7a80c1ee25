// SPDX-License-Identifier: MIT
// The device features that the backend uses.
#pragma once

#include <string>

#include "backends/vulkan/api.h"

namespace grisaille::vulkan {

// The feature structures of Vulkan 1.0, 1.2 and 1.3, linked through pNext.
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

// The first required feature that a device of Vulkan 1.3 lacks, or "".
std::string lackingFeature(VkPhysicalDevice device);

// Same for the features that effects in another program require; effects do not draw or submit.
std::string lackingForEffects(VkPhysicalDevice device);

// Enables all required features, and anisotropic filtering if the device has it.
void enableFeatures(VkPhysicalDevice device, FeatureChain& chain);

}  // namespace grisaille::vulkan
