// SPDX-License-Identifier: MIT
// Copies resources to the CPU. Both functions wait for all submitted work.
#pragma once

#include "backends/opengl/resources.h"

namespace grisaille::opengl {

// Both throw kStaleHandle, kOutOfDeviceMemory.
std::vector<std::byte> readTexture(Resources& resources, gpu::Texture texture, uint32_t mip,
                                   uint32_t layer);
std::vector<std::byte> readBuffer(Resources& resources, gpu::BufferRange range);

}  // namespace grisaille::opengl
