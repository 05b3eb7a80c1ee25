// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>

#include "backends/vulkan/features.h"
#include "backends/vulkan/instance.h"

namespace grisaille::vulkan {
namespace {

using gpu::Format;

std::string versionName(uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

bool shows(const Instance& instance, VkPhysicalDevice device, uint32_t family,
           VkSurfaceKHR surface) {
  if (surface == VK_NULL_HANDLE) return true;
  VkBool32 can = VK_FALSE;
  return instance.surface().support(device, family, surface, &can) == VK_SUCCESS && can == VK_TRUE;
}

bool hasSwapchains(VkPhysicalDevice device) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> list(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, list.data());
  return std::any_of(list.begin(), list.end(), [](const VkExtensionProperties& one) {
    return std::string_view(one.extensionName) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  });
}

// Finds the first queue family with graphics and compute that can present to `surface`, if there is
// a surface. Returns false if there is no such family.
bool findQueue(const Instance& instance, VkSurfaceKHR surface, Candidate& candidate) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(candidate.device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(candidate.device, &count, families.data());
  constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & kNeeded) != kNeeded) continue;
    if (!shows(instance, candidate.device, i, surface)) continue;
    candidate.queueFamily = i;
    candidate.timestampBits = families[i].timestampValidBits;
    return true;
  }
  return false;
}

VkFormatFeatureFlags neededOf(const gpu::FormatInfo& info, Format format) {
  VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT |
                                VK_FORMAT_FEATURE_TRANSFER_SRC_BIT |
                                VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
  needed |= info.depth ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT
                       : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
  if (info.blends) needed |= VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
  if (info.storage) needed |= VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT;
  if (!info.depth && format != Format::kR32Uint) {
    needed |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
  }
  return needed;
}

// The first format that the device does not support in every use that the layer allows, or "".
std::string lackingFormat(VkPhysicalDevice device) {
  for (int i = static_cast<int>(Format::kR8Unorm); i <= static_cast<int>(Format::kD32Float); ++i) {
    const Format format = static_cast<Format>(i);
    const gpu::FormatInfo& info = gpu::formatInfo(format);
    VkFormatProperties has{};
    vkGetPhysicalDeviceFormatProperties(device, vulkanFormat(format), &has);
    const VkFormatFeatureFlags needed = neededOf(info, format);
    if ((has.optimalTilingFeatures & needed) != needed) {
      return fmt::format("some use of the format {}", info.name);
    }
  }
  return "";
}

// Reads the device's name, driver and type. Of the requirements it checks only the version and the
// uniform range.
Candidate named(VkPhysicalDevice device) {
  Candidate candidate;
  candidate.device = device;
  VkPhysicalDeviceProperties old{};
  vkGetPhysicalDeviceProperties(device, &old);
  candidate.type = old.deviceType;
  candidate.listed.name = oneLine(old.deviceName);
  candidate.listed.driver = fmt::format("version {:#x}", old.driverVersion);
  candidate.listed.software = old.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  if (old.apiVersion < VK_API_VERSION_1_3) {
    candidate.lacks = fmt::format("Vulkan 1.3 (it has {})", versionName(old.apiVersion));
    return candidate;
  }
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
  vkGetPhysicalDeviceProperties2(device, &properties);
  candidate.listed.driver = oneLine(driver.driverName);
  // SwiftShader leaves driverInfo empty.
  if (driver.driverInfo[0] != '\0') candidate.listed.driver += " " + oneLine(driver.driverInfo);
  if (old.limits.maxUniformBufferRange < 65536) {
    candidate.lacks = "uniform ranges of 65536 bytes";
  }
  return candidate;
}

Candidate candidateOf(const Instance& instance, VkPhysicalDevice device, VkSurfaceKHR surface) {
  Candidate candidate = named(device);
  if (candidate.lacks.empty()) candidate.lacks = lackingFeature(device);
  if (candidate.lacks.empty() && surface != VK_NULL_HANDLE && !hasSwapchains(device)) {
    candidate.lacks = "swapchains, which show pictures in a window";
  }
  if (candidate.lacks.empty() && !findQueue(instance, surface, candidate)) {
    candidate.lacks = surface == VK_NULL_HANDLE
                          ? "a queue that draws and computes"
                          : "a queue that draws, computes and shows pictures in the window";
  }
  if (candidate.lacks.empty()) candidate.lacks = lackingFormat(device);
  return candidate;
}

int rankOf(const Candidate& candidate) {
  if (!candidate.lacks.empty()) return 5;
  switch (candidate.type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 4;
    default:
      return 3;
  }
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : static_cast<char>(c);
  });
  return text;
}

const Candidate* find(const std::vector<Candidate>& candidates, const std::string& wanted) {
  if (wanted.empty()) {
    return &*std::min_element(
        candidates.begin(), candidates.end(),
        [](const Candidate& a, const Candidate& b) { return rankOf(a) < rankOf(b); });
  }
  size_t number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto parsed = std::from_chars(wanted.data(), end, number);
  if (parsed.ec == std::errc() && parsed.ptr == end) {
    return number < candidates.size() ? &candidates[number] : nullptr;
  }
  for (const Candidate& candidate : candidates) {
    if (lower(candidate.listed.name).find(lower(wanted)) != std::string::npos) return &candidate;
  }
  return nullptr;
}

}  // namespace

std::vector<Candidate> candidates(const Instance& instance, VkSurfaceKHR surface) {
  std::vector<Candidate> list;
  for (const VkPhysicalDevice device : instance.devices()) {
    list.push_back(candidateOf(instance, device, surface));
  }
  return list;
}

const Candidate& choose(const std::vector<Candidate>& candidates, const std::string& wanted) {
  if (candidates.empty()) throw Error(ErrorId::kNoDevice, "there is no Vulkan device");
  const Candidate* chosen = find(candidates, wanted);
  if (chosen == nullptr) {
    std::string list;
    for (size_t i = 0; i < candidates.size(); ++i) {
      list += fmt::format("{}{}: {}", i == 0 ? "" : ", ", i, candidates[i].listed.name);
    }
    throw Error(ErrorId::kNoDevice, "Vulkan has no device '{}', only {}", wanted, list);
  }
  if (!chosen->lacks.empty()) {
    throw Error(ErrorId::kDeviceTooOld, "{} lacks {}", chosen->listed.name, chosen->lacks);
  }
  return *chosen;
}

Candidate foreignCandidate(VkPhysicalDevice device, uint32_t queueFamily) {
  Candidate candidate = named(device);
  if (candidate.lacks.empty()) candidate.lacks = lackingForEffects(device);
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  if (candidate.lacks.empty() && queueFamily >= count) {
    candidate.lacks = fmt::format("queue family {} (it has {})", queueFamily, count);
  } else if (candidate.lacks.empty() &&
             (families[queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
    candidate.lacks = fmt::format("compute in queue family {}", queueFamily);
  }
  if (!candidate.lacks.empty()) {
    throw Error(ErrorId::kHostDevice, "{} lacks {}", candidate.listed.name, candidate.lacks);
  }
  candidate.queueFamily = queueFamily;
  return candidate;
}

VkFormat vulkanFormat(Format format) {
  switch (format) {
    case Format::kNone:
      return VK_FORMAT_UNDEFINED;
    case Format::kR8Unorm:
      return VK_FORMAT_R8_UNORM;
    case Format::kRgba8Unorm:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case Format::kRgba8Srgb:
      return VK_FORMAT_R8G8B8A8_SRGB;
    case Format::kR16Float:
      return VK_FORMAT_R16_SFLOAT;
    case Format::kRgba16Float:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::kR32Float:
      return VK_FORMAT_R32_SFLOAT;
    case Format::kRg32Float:
      return VK_FORMAT_R32G32_SFLOAT;
    case Format::kRgba32Float:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Format::kR32Uint:
      return VK_FORMAT_R32_UINT;
    case Format::kD32Float:
      return VK_FORMAT_D32_SFLOAT;
  }
  return VK_FORMAT_UNDEFINED;
}

}  // namespace grisaille::vulkan
