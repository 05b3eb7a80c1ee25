// SPDX-License-Identifier: MIT
// Builds OpenGL programs from compiled shaders.
#pragma once

#include "backends/opengl/resources.h"

namespace grisaille::opengl {

// Both throw kShaderRefused, kShaderMissing.
ComputePipelineResource buildCompute(const gpu::ComputePipelineDesc& desc);
GraphicsPipelineResource buildGraphics(const gpu::GraphicsPipelineDesc& desc);

}  // namespace grisaille::opengl
