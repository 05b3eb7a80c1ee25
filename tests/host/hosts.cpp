// SPDX-License-Identifier: MIT
#include "tests/host/hosts.h"

#include "tests/host/opengl_host.h"
#include "tests/host/vulkan_host.h"

namespace grisaille::tests {

std::unique_ptr<Host> makeHost(const std::string& api, bool validate) {
  return api == "vulkan" ? makeVulkanHost(validate) : makeOpenGlHost();
}

}  // namespace grisaille::tests
