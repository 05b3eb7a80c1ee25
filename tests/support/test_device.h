// SPDX-License-Identifier: MIT
// The devices that suites run on: each backend with the system's drivers, and every further Vulkan
// driver.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace grisaille::tests {

struct TestDevice {
  std::string label;    // part of test names: "opengl", "vulkan", "vulkan_swiftshader"
  std::string backend;  // value of `--backend`
  std::string driver;   // absolute path of the Vulkan driver's ICD file; "": the system's drivers
};

std::ostream& operator<<(std::ostream& stream, const TestDevice& device);

// The system's devices, in the program's order of backends.
TestDevice systemOpenGl();
TestDevice systemVulkan();

// One device per ICD file in the colon-separated environment variable
// GRISAILLE_TEST_VULKAN_DRIVERS; without the variable, SwiftShader. The list includes drivers that
// are not installed, so that their tests are visibly skipped.
std::vector<TestDevice> furtherVulkan();

// All of the devices above; only those on Vulkan.
std::vector<TestDevice> testDevices();
std::vector<TestDevice> vulkanTestDevices();

// Says that the device's ICD file is missing, which skips its tests. "" if the file exists, and for
// the system's drivers.
std::string whyMissing(const TestDevice& device);

// testDevices() without the missing ones.
std::vector<TestDevice> installedDevices();

// Environment variables ("NAME=value") for a child process. With them, the device is the only
// Vulkan device and therefore the default. Empty for the system's drivers.
std::vector<std::string> driverEnvironment(const TestDevice& device);

// While it lives, new Vulkan instances of this process find only the device's driver. The loader
// reads the environment at each instance creation; existing instances keep their drivers. Scopes
// nest. No other thread may create an instance or read the environment meanwhile.
class DriverScope {
 public:
  explicit DriverScope(const TestDevice& device);
  ~DriverScope();
  DriverScope(const DriverScope&) = delete;
  DriverScope& operator=(const DriverScope&) = delete;

 private:
  struct Variable {
    std::string name, value;
    bool set = false;
  };
  std::vector<Variable> before_;
};

}  // namespace grisaille::tests

// For INSTANTIATE_TEST_SUITE_P: names each test after its device.
#define GRISAILLE_DEVICE_NAME [](const auto& test) { return test.param.label; }
