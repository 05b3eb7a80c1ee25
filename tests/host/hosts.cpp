// SPDX-License-Identifier: MIT
#include "tests/host/hosts.h"

#include "tests/host/opengl_host.h"
#include "tests/host/vulkan_host.h"

namespace grisaille::tests {

std::unique_ptr<Host> makeHost(const TestDevice& device, bool validate) {
  const DriverScope scope(device);
  return device.backend == "vulkan" ? makeVulkanHost(validate) : makeOpenGlHost();
}

}  // namespace grisaille::tests
