// SPDX-License-Identifier: MIT
// Vulkan memory from the host's functions.
#pragma once

#include <memory>

#include "backends/vulkan/vulkan.h"
#include "grisaille/host.h"

namespace grisaille::host {

// Null without functions. Throws kHostNull, kHostStruct, kHostValue.
std::unique_ptr<vulkan::MemorySource> memorySource(const grisaille_host_allocator* allocator);

}  // namespace grisaille::host
