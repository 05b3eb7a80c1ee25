// SPDX-License-Identifier: MIT
// What the current context can do.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::opengl {

gpu::DeviceInfo readInfo(const gpu::ListedDevice& device);

}  // namespace grisaille::opengl
