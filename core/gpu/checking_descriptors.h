// SPDX-License-Identifier: MIT
// What a descriptor must be before a resource is made of it. Each function throws an error of 11xx.
#pragma once

#include "core/gpu/types.h"

namespace grisaille::gpu {

void checkDescriptor(const BufferDesc& desc, const Capabilities& capabilities);
void checkDescriptor(const TextureDesc& desc, const Capabilities& capabilities);
void checkDescriptor(const ComputePipelineDesc& desc);
void checkDescriptor(const GraphicsPipelineDesc& desc);

}  // namespace grisaille::gpu
