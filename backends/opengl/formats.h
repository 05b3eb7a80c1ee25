// SPDX-License-Identifier: MIT
// Maps the layer's formats to OpenGL's enumerants.
#pragma once

#include <cstdint>

#include "core/gpu/types.h"

namespace grisaille::opengl {

struct GlFormat {
  uint32_t internalFormat;
  uint32_t transferFormat;  // of uploads and readbacks
  uint32_t transferType;
};

const GlFormat& glFormat(gpu::Format format);

}  // namespace grisaille::opengl
