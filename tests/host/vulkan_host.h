// SPDX-License-Identifier: MIT
#pragma once

#include "tests/host/hosts.h"

namespace grisaille::tests {

std::unique_ptr<Host> makeVulkanHost(bool validate = true);

// What a Vulkan host's device is made of.
host::VulkanSpec vulkanSpec(const Host& host);

}  // namespace grisaille::tests
