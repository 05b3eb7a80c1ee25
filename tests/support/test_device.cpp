// SPDX-License-Identifier: MIT
#include "tests/support/test_device.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDrivers = "GRISAILLE_TEST_VULKAN_DRIVERS";

// Where Linux distributions install SwiftShader. The first existing file is used.
constexpr const char* kSwiftShader[] = {"/usr/lib/chromium/vk_swiftshader_icd.json",
                                        "/usr/lib64/chromium-browser/vk_swiftshader_icd.json",
                                        "/opt/google/chrome/vk_swiftshader_icd.json"};

// Both "vk_swiftshader_icd.json" and "swiftshader_icd.x86_64.json" give "swiftshader".
std::string driverName(const fs::path& file) {
  std::string name = file.filename();
  name = name.substr(0, name.find("_icd"));
  name = name.substr(0, name.find(".json"));
  if (name.starts_with("vk_")) name = name.substr(3);
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

TestDevice driverDevice(const std::string& file) {
  return {.label = "vulkan_" + driverName(file), .backend = "vulkan", .driver = file};
}

}  // namespace

std::ostream& operator<<(std::ostream& stream, const TestDevice& device) {
  return stream << device.label;
}

TestDevice systemOpenGl() {
  return {.label = "opengl", .backend = "opengl", .driver = ""};
}

TestDevice systemVulkan() {
  return {.label = "vulkan", .backend = "vulkan", .driver = ""};
}

std::vector<TestDevice> furtherVulkan() {
  const char* given = std::getenv(kDrivers);
  if (given == nullptr) {
    const auto* found = std::find_if(std::begin(kSwiftShader), std::end(kSwiftShader),
                                     [](const char* file) { return fs::exists(file); });
    return {driverDevice(found == std::end(kSwiftShader) ? kSwiftShader[0] : *found)};
  }
  std::vector<TestDevice> list;
  std::istringstream files(given);
  for (std::string file; std::getline(files, file, ':');) {
    if (file.empty()) continue;
    TestDevice device = driverDevice(file);
    // Files of the same name may come from different folders.
    const auto same = [&](const TestDevice& other) { return other.label == device.label; };
    while (std::any_of(list.begin(), list.end(), same)) device.label += "_again";
    list.push_back(std::move(device));
  }
  return list;
}

std::vector<TestDevice> vulkanTestDevices() {
  std::vector<TestDevice> list = furtherVulkan();
  list.insert(list.begin(), systemVulkan());
  return list;
}

std::vector<TestDevice> testDevices() {
  std::vector<TestDevice> list = vulkanTestDevices();
  list.insert(list.begin(), systemOpenGl());
  return list;
}

std::string whyMissing(const TestDevice& device) {
  if (device.driver.empty() || fs::exists(device.driver)) return "";
  return "there is no Vulkan driver at " + device.driver +
         "; install it (Debian: the package chromium holds SwiftShader), or name its ICD file in " +
         kDrivers;
}

std::vector<TestDevice> installedDevices() {
  std::vector<TestDevice> list = testDevices();
  std::erase_if(list, [](const TestDevice& device) { return !whyMissing(device).empty(); });
  return list;
}

std::vector<std::string> driverEnvironment(const TestDevice& device) {
  if (device.driver.empty()) return {};
  // Loaders before 1.3.207 know only VK_ICD_FILENAMES.
  return {"VK_DRIVER_FILES=" + device.driver, "VK_ICD_FILENAMES=" + device.driver};
}

DriverScope::DriverScope(const TestDevice& device) {
  for (const std::string& variable : driverEnvironment(device)) {
    const size_t equals = variable.find('=');
    const std::string name = variable.substr(0, equals);
    const char* value = std::getenv(name.c_str());
    before_.push_back({name, value == nullptr ? "" : value, value != nullptr});
    setenv(name.c_str(), variable.c_str() + equals + 1, 1);
  }
}

DriverScope::~DriverScope() {
  for (const Variable& variable : before_) {
    if (variable.set) {
      setenv(variable.name.c_str(), variable.value.c_str(), 1);
    } else {
      unsetenv(variable.name.c_str());
    }
  }
}

}  // namespace grisaille::tests
