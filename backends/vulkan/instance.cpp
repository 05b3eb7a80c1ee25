// SPDX-License-Identifier: MIT
#include "backends/vulkan/instance.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <mutex>

namespace grisaille::vulkan {
namespace {

constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

// Loads Vulkan through `entry`, a loader's entry point; null takes libvulkan.so.1.
void loadLibrary(PFN_vkGetInstanceProcAddr entry = nullptr) {
  static const VkResult loaded = [&] {
    if (entry == nullptr) return volkInitialize();
    volkInitializeCustom(entry);
    return VK_SUCCESS;
  }();
  if (loaded != VK_SUCCESS) {
    throw Error(ErrorId::kBackendMissing, "the Vulkan loader (libvulkan.so.1) is not installed");
  }
  const uint32_t version = volkGetInstanceVersion();
  if (version < VK_API_VERSION_1_3) {
    throw Error(ErrorId::kDeviceTooOld, "the Vulkan loader supports {}.{}, and 1.3 is needed",
                VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));
  }
}

bool hasExtension(const char* layer, std::string_view name) {
  uint32_t count = 0;
  check(vkEnumerateInstanceExtensionProperties(layer, &count, nullptr),
        "vkEnumerateInstanceExtensionProperties");
  std::vector<VkExtensionProperties> list(count);
  check(vkEnumerateInstanceExtensionProperties(layer, &count, list.data()),
        "vkEnumerateInstanceExtensionProperties");
  return std::any_of(list.begin(), list.end(),
                     [&](const VkExtensionProperties& one) { return one.extensionName == name; });
}

bool hasLayer(std::string_view name) {
  uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
  std::vector<VkLayerProperties> list(count);
  check(vkEnumerateInstanceLayerProperties(&count, list.data()),
        "vkEnumerateInstanceLayerProperties");
  return std::any_of(list.begin(), list.end(),
                     [&](const VkLayerProperties& one) { return one.layerName == name; });
}

// The sentence of a validation message. The layer puts objects and numbers before it, separated by
// bars.
std::string_view sentenceOf(std::string_view text) {
  const size_t bar = text.rfind(" | ");
  return bar == std::string_view::npos ? text : text.substr(bar + 3);
}

VkBool32 VKAPI_PTR onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                             VkDebugUtilsMessageTypeFlagsEXT,
                             const VkDebugUtilsMessengerCallbackDataEXT* data,
                             void* sink) noexcept {
  const char* id = data->pMessageIdName != nullptr ? data->pMessageIdName : "Vulkan";
  const char* text = data->pMessage != nullptr ? data->pMessage : "";
  const bool error = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
  (*static_cast<const gpu::MessageSink*>(sink))(
      error ? gpu::Severity::kError : gpu::Severity::kWarning,
      oneLine(fmt::format("{}: {}", id, sentenceOf(text))));
  return VK_FALSE;
}

// Leaves out general messages: during instance creation the loader sends them, about the drivers of
// other devices.
VkDebugUtilsMessengerCreateInfoEXT messengerInfo(const gpu::MessageSink& sink) {
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = onMessage;
  info.pUserData = const_cast<gpu::MessageSink*>(&sink);
  return info;
}

void printMessage(gpu::Severity severity, std::string_view text) {
  static constexpr const char* kNames[] = {"info", "warning", "error"};
  fmt::print(stderr, "vulkan {}: {}\n", kNames[static_cast<int>(severity)], text);
}

}  // namespace

Instance::Instance(gpu::MessageSink message)
    : message_(message ? std::move(message) : printMessage) {}

Instance::Instance(bool check, gpu::MessageSink message, std::span<const char* const> extensions)
    : Instance(std::move(message)) {
  loadLibrary();
  const bool debugUtils = hasExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  const bool validate = check && debugUtils && hasLayer(kLayer);
  if (check && !validate) {
    message_(gpu::Severity::kInfo, "the Vulkan validation layer is not installed");
  }
  create(debugUtils, validate, extensions);
  load(debugUtils);
  if (validate) createMessenger();
}

Instance::Instance(const HostHandles& host)
    : instance_(static_cast<VkInstance>(host.instance)), foreign_(true) {
  loadLibrary(reinterpret_cast<PFN_vkGetInstanceProcAddr>(host.getInstanceProcAddr));
  load(true);  // finds nothing unless the program enabled the extension
}

void Instance::load(bool debugUtils) {
  // The loader's own entry points serve every instance: set volk's globals once.
  static std::once_flag once;
  std::call_once(once, [this] { volkLoadInstanceOnly(instance_); });
  const auto find = [this](auto& function, const char* name) {
    function =
        reinterpret_cast<std::decay_t<decltype(function)>>(vkGetInstanceProcAddr(instance_, name));
  };
  if (debugUtils) {
    find(debug_.setName, "vkSetDebugUtilsObjectNameEXT");
    find(debug_.beginLabel, "vkCmdBeginDebugUtilsLabelEXT");
    find(debug_.endLabel, "vkCmdEndDebugUtilsLabelEXT");
  }
  find(surface_.destroy, "vkDestroySurfaceKHR");
  find(surface_.support, "vkGetPhysicalDeviceSurfaceSupportKHR");
  find(surface_.capabilities, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  find(surface_.formats, "vkGetPhysicalDeviceSurfaceFormatsKHR");
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) destroyMessenger_(instance_, messenger_, nullptr);
  if (instance_ != VK_NULL_HANDLE && !foreign_) vkDestroyInstance(instance_, nullptr);
}

void Instance::create(bool debugUtils, bool validate, std::span<const char* const> others) {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "grisaille";
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  std::vector<const char*> extensions(others.begin(), others.end());
  if (debugUtils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

  VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(message_);
  const VkValidationFeatureEnableEXT enabled =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &enabled;
#ifdef VK_EXT_layer_settings
  // Newer layers leave out what shaders read and write unless they are told.
  const VkBool32 yes = VK_TRUE;
  const VkLayerSettingEXT shaders = {kLayer, "syncval_shader_accesses_heuristic",
                                     VK_LAYER_SETTING_TYPE_BOOL32_EXT, 1, &yes};
  VkLayerSettingsCreateInfoEXT settings{VK_STRUCTURE_TYPE_LAYER_SETTINGS_CREATE_INFO_EXT};
  settings.settingCount = 1;
  settings.pSettings = &shaders;
#endif
  if (validate) {
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kLayer;
    info.pNext = &messenger;
    if (hasExtension(kLayer, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME)) {
      extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
      messenger.pNext = &features;
    }
#ifdef VK_EXT_layer_settings
    if (hasExtension(kLayer, VK_EXT_LAYER_SETTINGS_EXTENSION_NAME)) {
      extensions.push_back(VK_EXT_LAYER_SETTINGS_EXTENSION_NAME);
      features.pNext = &settings;
    }
#endif
  }
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance (is a driver installed?)",
        ErrorId::kBackendMissing);
}

void Instance::createMessenger() {
  const auto make = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  destroyMessenger_ = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
  VkDebugUtilsMessengerCreateInfoEXT info = messengerInfo(message_);
  check(make(instance_, &info, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

std::vector<VkPhysicalDevice> Instance::devices() const {
  uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices",
        ErrorId::kNoDevice);
  std::vector<VkPhysicalDevice> list(count);
  check(vkEnumeratePhysicalDevices(instance_, &count, list.data()), "vkEnumeratePhysicalDevices",
        ErrorId::kNoDevice);
  list.resize(count);
  return list;
}

}  // namespace grisaille::vulkan
