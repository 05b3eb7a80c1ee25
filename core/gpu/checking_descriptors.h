// SPDX-License-Identifier: MIT
// Validates descriptors before resources are created from them. Each function throws an error 11xx.
#pragma once

#include "core/gpu/types.h"

namespace grisaille::gpu {

void checkDescriptor(const BufferDesc& desc, const Capabilities& capabilities);
void checkDescriptor(const TextureDesc& desc, const Capabilities& capabilities);
void checkDescriptor(const ComputePipelineDesc& desc);
void checkDescriptor(const GraphicsPipelineDesc& desc);

}  // namespace grisaille::gpu
