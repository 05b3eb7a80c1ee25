// SPDX-License-Identifier: MIT
// A Vulkan device with messages that fail the test; tests run once with each driver and are skipped
// where it is missing.
#pragma once

#include <gtest/gtest.h>

#include "backends/vulkan/vulkan.h"
#include "tests/support/devices.h"

namespace grisaille::vulkan {

class WithDevice : public ::testing::TestWithParam<tests::TestDevice> {
 protected:
  void SetUp() override {
    const std::string why = tests::whyAbsent(GetParam());
    if (!why.empty()) GTEST_SKIP() << why;
    driver_ = std::make_unique<tests::DriverScope>(GetParam());
  }
  void TearDown() override { driver_.reset(); }

  static std::unique_ptr<gpu::Device> open(bool check = true) {
    gpu::DeviceOptions options;
    options.check = check;
    options.message = [](gpu::Severity severity, std::string_view text) {
      if (severity != gpu::Severity::kInfo) ADD_FAILURE() << text;
    };
    return createDevice(options);
  }

 private:
  std::unique_ptr<tests::DriverScope> driver_;
};

// Runs the tests of a WithDevice with every driver.
#define GRISAILLE_ON_EVERY_VULKAN_DEVICE(Suite)                                                   \
  INSTANTIATE_TEST_SUITE_P(, Suite, ::testing::ValuesIn(::grisaille::tests::vulkanTestDevices()), \
                           GRISAILLE_DEVICE_NAME)

}  // namespace grisaille::vulkan
