// SPDX-License-Identifier: MIT
// Textures of other programs, in the formats that a shader samples as floats.
#pragma once

#include "backends/opengl/resources.h"
#include "core/gpu/host_device.h"

namespace grisaille::opengl {

// Throws kHostTexture if shaders cannot read the texture as described.
TextureResource wrapForeign(const gpu::ForeignTexture& texture);

gpu::ForeignInfo describeForeign(const TextureResource& texture);

}  // namespace grisaille::opengl
