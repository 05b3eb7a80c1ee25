// SPDX-License-Identifier: MIT
#include "backends/vulkan/features.h"

namespace grisaille::vulkan {
namespace {

struct Required {
  const char* name;
  VkBool32& (*of)(FeatureChain&);
  bool effects = false;  // required also by effects in another program
};

constexpr Required kRequired[] = {
    // For storage images of the formats r8, r16f and rg32f.
    {"shaderStorageImageExtendedFormats",
     [](FeatureChain& c) -> VkBool32& { return c.v10.features.shaderStorageImageExtendedFormats; },
     true},
    {"fragmentStoresAndAtomics",
     [](FeatureChain& c) -> VkBool32& { return c.v10.features.fragmentStoresAndAtomics; }},
    // For indices above 2^24.
    {"fullDrawIndexUint32",
     [](FeatureChain& c) -> VkBool32& { return c.v10.features.fullDrawIndexUint32; }},
    {"timelineSemaphore", [](FeatureChain& c) -> VkBool32& { return c.v12.timelineSemaphore; }},
    {"dynamicRendering", [](FeatureChain& c) -> VkBool32& { return c.v13.dynamicRendering; }},
    {"synchronization2", [](FeatureChain& c) -> VkBool32& { return c.v13.synchronization2; }, true},
    // For LocalSizeId, which SPIR-V 1.6 uses in every compute shader with constant group sizes.
    {"maintenance4", [](FeatureChain& c) -> VkBool32& { return c.v13.maintenance4; }, true},
};

std::string firstLacking(VkPhysicalDevice device, bool forEffects) {
  FeatureChain there;
  vkGetPhysicalDeviceFeatures2(device, &there.v10);
  for (const Required& required : kRequired) {
    if (forEffects && !required.effects) continue;
    if (required.of(there) == VK_FALSE) return fmt::format("the feature {}", required.name);
  }
  return "";
}

}  // namespace

std::string lackingFeature(VkPhysicalDevice device) {
  return firstLacking(device, false);
}

std::string lackingForEffects(VkPhysicalDevice device) {
  return firstLacking(device, true);
}

void enableFeatures(VkPhysicalDevice device, FeatureChain& chain) {
  FeatureChain there;
  vkGetPhysicalDeviceFeatures2(device, &there.v10);
  for (const Required& required : kRequired) required.of(chain) = VK_TRUE;
  chain.v10.features.samplerAnisotropy = there.v10.features.samplerAnisotropy;
}

}  // namespace grisaille::vulkan
