// SPDX-License-Identifier: MIT
// A Vulkan device whose messages fail the test; tests are skipped where there is none.
#pragma once

#include <gtest/gtest.h>

#include "backends/vulkan/vulkan.h"
#include "core/error.h"

namespace grisaille::vulkan {

class WithDevice : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      if (!listDevices().empty()) return;
    } catch (const Error& error) {
      if (error.id() != ErrorId::kBackendMissing) throw;
    }
    GTEST_SKIP() << "this machine has no Vulkan device";
  }

  static std::unique_ptr<gpu::Device> open(bool check = true) {
    gpu::DeviceOptions options;
    options.check = check;
    options.message = [](gpu::Severity severity, std::string_view text) {
      if (severity != gpu::Severity::kInfo) ADD_FAILURE() << text;
    };
    return createDevice(options);
  }
};

}  // namespace grisaille::vulkan
