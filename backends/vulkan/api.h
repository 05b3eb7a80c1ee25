// SPDX-License-Identifier: MIT
// Includes the Vulkan API, and turns its results into errors.
#pragma once

#include <volk.h>

#include <string_view>

#include "core/base/error.h"

namespace grisaille::vulkan {

// Throws kOutOfDeviceMemory, kDeviceLost or, for other failures, `otherwise`. `what` names the
// call.
void check(VkResult result, std::string_view what, ErrorId otherwise = ErrorId::kDeviceFailed);

}  // namespace grisaille::vulkan
