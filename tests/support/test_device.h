// SPDX-License-Identifier: MIT
// The devices that suites run on: each backend with the system's drivers, and each further Vulkan
// driver.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace grisaille::tests {

struct TestDevice {
  std::string label;    // names tests: "opengl", "vulkan", "vulkan_swiftshader"
  std::string backend;  // as `--backend`
  std::string driver;   // absolute path of the Vulkan driver's ICD file; "": the system's drivers
};

std::ostream& operator<<(std::ostream& stream, const TestDevice& device);

// The system's devices, in the order of the program's backends.
TestDevice systemOpenGl();
TestDevice systemVulkan();

// One device for each ICD file that the environment variable GRISAILLE_TEST_VULKAN_DRIVERS lists,
// parted by colons. Without that variable: SwiftShader. A device is in the list whether its driver
// is installed or not, so that a test of a missing one is skipped visibly.
std::vector<TestDevice> furtherVulkan();

// All of these, and those of Vulkan alone.
std::vector<TestDevice> testDevices();
std::vector<TestDevice> vulkanTestDevices();

// Why tests of this device are skipped: its ICD file is missing. "" for the system's drivers.
std::string whyMissing(const TestDevice& device);

// Those of testDevices() that are not missing.
std::vector<TestDevice> installedDevices();

// For a child process: variables ("NAME=value") that make the device the only Vulkan device, and so
// its default. None for the system's drivers.
std::vector<std::string> driverEnvironment(const TestDevice& device);

// Makes the device's driver the only one that new Vulkan instances of this process find. The loader
// reads the environment whenever an instance is made; instances that exist keep their drivers.
// Scopes nest. Not while another thread makes an instance or reads the environment.
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

// For INSTANTIATE_TEST_SUITE_P: names a test by its device.
#define GRISAILLE_DEVICE_NAME [](const auto& test) { return test.param.label; }
