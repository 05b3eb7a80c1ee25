// SPDX-License-Identifier: MIT
// Reads the capabilities of the current context.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::opengl {

gpu::DeviceInfo readInfo(const gpu::ListedDevice& device);

}  // namespace grisaille::opengl
