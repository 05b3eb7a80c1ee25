// SPDX-License-Identifier: MIT
#pragma once

#include "tests/host/hosts.h"

namespace grisaille::tests {

std::unique_ptr<Host> makeVulkanHost(bool validate = true);

// The specification that wraps a Vulkan host's device.
host::VulkanSpec vulkanSpec(const Host& host);

struct MemoryType {
  uint32_t index = 0;
  bool mappable = false;
};

// The first memory type that a request allows.
MemoryType memoryTypeFor(const host::VulkanSpec& spec,
                         const grisaille_host_memory_request& request);

// Allocates for a request, and maps what can be mapped.
int allocateFor(const host::VulkanSpec& spec, const grisaille_host_memory_request& request,
                grisaille_host_memory& out);

// The VkImageLayout of textures that a Vulkan host creates from now on; at first GENERAL.
void useLayout(Host& host, uint32_t layout);

}  // namespace grisaille::tests
