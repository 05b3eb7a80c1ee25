// SPDX-License-Identifier: MIT
#pragma once

#include "tests/host/hosts.h"

namespace grisaille::tests {

std::unique_ptr<Host> makeVulkanHost(bool validate = true);

// The specification that wraps a Vulkan host's device.
host::VulkanSpec vulkanSpec(const Host& host);

}  // namespace grisaille::tests
