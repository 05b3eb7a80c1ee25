// SPDX-License-Identifier: MIT
// Compute and graphics pipelines with their descriptor set layouts.
#pragma once

#include <array>
#include <vector>

#include "backends/vulkan/context.h"

namespace grisaille::vulkan {

struct PipelineObject {
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
  std::array<const gpu::Shader*, 2> shaders = {};   // compute; or vertex and fragment
  std::vector<const grisaille_shader_slot*> slots;  // slots of all shaders, each binding once
};

// Both throw kShaderRefused if the driver rejects the shaders.
PipelineObject makePipeline(Context& context, VkPipelineCache cache,
                            const gpu::ComputePipelineDesc& desc);
PipelineObject makePipeline(Context& context, VkPipelineCache cache,
                            const gpu::GraphicsPipelineDesc& desc);

void release(Context& context, PipelineObject& object);

// A slot's binding number in set 0.
inline uint32_t bindingNumber(uint32_t slotClass, uint32_t slot) {
  return GRISAILLE_SLOTS_PER_CLASS * slotClass + slot;
}

VkDescriptorType descriptorType(uint32_t slotClass);

}  // namespace grisaille::vulkan
