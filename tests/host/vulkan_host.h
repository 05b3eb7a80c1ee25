// SPDX-License-Identifier: MIT
#pragma once

#include "tests/host/hosts.h"

namespace grisaille::tests {

std::unique_ptr<Host> makeVulkanHost(bool validate = true);

// The specification that wraps a Vulkan host's device.
host::VulkanSpec vulkanSpec(const Host& host);

// The VkImageLayout of textures that a Vulkan host creates from now on; at first GENERAL.
void useLayout(Host& host, uint32_t layout);

}  // namespace grisaille::tests
