// SPDX-License-Identifier: MIT
#include "backends/vulkan/pipelines.h"

#include <algorithm>
#include <map>
#include <optional>

namespace grisaille::vulkan {
namespace {

class Module {
 public:
  Module(Context& context, const gpu::Shader& shader) : context_(context) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = shader.spirv_words * sizeof(uint32_t);
    info.pCode = shader.spirv;
    check(context.vk.vkCreateShaderModule(context.device, &info, context.callbacks, &module_),
          fmt::format("vkCreateShaderModule of {}", shader.name), ErrorId::kShaderRefused);
  }
  ~Module() { context_.vk.vkDestroyShaderModule(context_.device, module_, context_.callbacks); }
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;

  VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit,
                                        const VkSpecializationInfo& constants) const {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = bit;
    info.module = module_;
    info.pName = "main";
    info.pSpecializationInfo = &constants;
    return info;
  }

 private:
  Context& context_;
  VkShaderModule module_ = VK_NULL_HANDLE;
};

// The specialisation info of a shader. It refers to `values` itself: each entry points at the bits
// of its Specialization.
struct Constants {
  explicit Constants(std::span<const gpu::Specialization> values) {
    for (size_t i = 0; i < values.size(); ++i) {
      const size_t at = i * sizeof(gpu::Specialization) + offsetof(gpu::Specialization, bits);
      entries.push_back({values[i].id, static_cast<uint32_t>(at), sizeof(uint32_t)});
    }
    info.mapEntryCount = static_cast<uint32_t>(entries.size());
    info.pMapEntries = entries.data();
    info.dataSize = values.size_bytes();
    info.pData = values.data();
  }
  Constants(const Constants&) = delete;
  Constants& operator=(const Constants&) = delete;

  std::vector<VkSpecializationMapEntry> entries;
  VkSpecializationInfo info{};
};

VkShaderStageFlags stageOf(const gpu::Shader& shader) {
  switch (shader.stage) {
    case GRISAILLE_STAGE_VERTEX:
      return VK_SHADER_STAGE_VERTEX_BIT;
    case GRISAILLE_STAGE_FRAGMENT:
      return VK_SHADER_STAGE_FRAGMENT_BIT;
    default:
      return VK_SHADER_STAGE_COMPUTE_BIT;
  }
}

void makeLayouts(Context& context, PipelineObject& object) {
  std::map<uint32_t, VkDescriptorSetLayoutBinding> bindings;
  for (const gpu::Shader* shader : object.shaders) {
    if (shader == nullptr) continue;
    for (uint32_t i = 0; i < shader->slot_count; ++i) {
      const grisaille_shader_slot& slot = shader->slots[i];
      const uint32_t number = bindingNumber(slot.slot_class, slot.slot);
      VkDescriptorSetLayoutBinding& binding = bindings[number];
      if (binding.descriptorCount == 0) object.slots.push_back(&slot);
      binding.binding = number;
      binding.descriptorType = descriptorType(slot.slot_class);
      binding.descriptorCount = 1;
      binding.stageFlags |= stageOf(*shader);
    }
  }
  std::vector<VkDescriptorSetLayoutBinding> list;
  for (const auto& [number, binding] : bindings) list.push_back(binding);
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.bindingCount = static_cast<uint32_t>(list.size());
  set.pBindings = list.data();
  check(context.vk.vkCreateDescriptorSetLayout(context.device, &set, context.callbacks,
                                               &object.setLayout),
        "vkCreateDescriptorSetLayout");
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &object.setLayout;
  check(
      context.vk.vkCreatePipelineLayout(context.device, &layout, context.callbacks, &object.layout),
      "vkCreatePipelineLayout");
}

VkFormat attributeFormat(gpu::AttributeFormat format) {
  static constexpr VkFormat kFormats[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                          VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT,
                                          VK_FORMAT_R8G8B8A8_UNORM};
  return kFormats[static_cast<size_t>(format)];
}

struct VertexInput {
  explicit VertexInput(const gpu::GraphicsPipelineDesc& desc) {
    for (uint32_t i = 0; i < desc.streamStrides.size(); ++i) {
      streams.push_back({i, desc.streamStrides[i], VK_VERTEX_INPUT_RATE_VERTEX});
    }
    for (const gpu::VertexAttribute& one : desc.attributes) {
      attributes.push_back({one.location, one.stream, attributeFormat(one.format), one.offset});
    }
    info.vertexBindingDescriptionCount = static_cast<uint32_t>(streams.size());
    info.pVertexBindingDescriptions = streams.data();
    info.vertexAttributeDescriptionCount = static_cast<uint32_t>(attributes.size());
    info.pVertexAttributeDescriptions = attributes.data();
  }
  VertexInput(const VertexInput&) = delete;
  VertexInput& operator=(const VertexInput&) = delete;

  std::vector<VkVertexInputBindingDescription> streams;
  std::vector<VkVertexInputAttributeDescription> attributes;
  VkPipelineVertexInputStateCreateInfo info{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
};

// Blends with straight alpha.
VkPipelineColorBlendAttachmentState blendState(gpu::Blend blend) {
  VkPipelineColorBlendAttachmentState state{};
  state.blendEnable = blend == gpu::Blend::kNone ? VK_FALSE : VK_TRUE;
  state.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_ADD;
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                         VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  return state;
}

// The state between vertex input and targets. Pipelines differ in it only by the number of colour
// targets, their blending, and whether they have depth.
struct FixedState {
  explicit FixedState(const gpu::GraphicsPipelineDesc& desc) {
    const bool withDepth = desc.depthFormat != gpu::Format::kNone;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport.viewportCount = viewport.scissorCount = 1;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    depth.depthTestEnable = depth.depthWriteEnable = withDepth ? VK_TRUE : VK_FALSE;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER;
    targets.assign(desc.colorFormats.size(), blendState(desc.blend));
    blend.attachmentCount = static_cast<uint32_t>(targets.size());
    blend.pAttachments = targets.data();
    dynamic.dynamicStateCount = static_cast<uint32_t>(std::size(kDynamic));
    dynamic.pDynamicStates = kDynamic;
  }
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;

  static constexpr VkDynamicState kDynamic[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                                VK_DYNAMIC_STATE_CULL_MODE};
  std::vector<VkPipelineColorBlendAttachmentState> targets;
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  VkPipelineRasterizationStateCreateInfo raster{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  VkPipelineMultisampleStateCreateInfo samples{
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  VkPipelineDepthStencilStateCreateInfo depth{
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  VkPipelineColorBlendStateCreateInfo blend{
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
};

void makeCompute(Context& context, VkPipelineCache cache, const gpu::ComputePipelineDesc& desc,
                 PipelineObject& object) {
  const Module module(context, *desc.shader);
  const Constants constants(desc.constants);
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = module.stage(VK_SHADER_STAGE_COMPUTE_BIT, constants.info);
  info.layout = object.layout;
  check(context.vk.vkCreateComputePipelines(context.device, cache, 1, &info, context.callbacks,
                                            &object.pipeline),
        fmt::format("compiling {}", desc.shader->name), ErrorId::kShaderRefused);
}

void makeGraphics(Context& context, VkPipelineCache cache, const gpu::GraphicsPipelineDesc& desc,
                  PipelineObject& object) {
  const Constants constants(desc.constants);
  const Module vertex(context, *desc.vertex);
  std::optional<Module> fragment;
  std::vector<VkPipelineShaderStageCreateInfo> stages = {
      vertex.stage(VK_SHADER_STAGE_VERTEX_BIT, constants.info)};
  if (desc.fragment != nullptr) {
    fragment.emplace(context, *desc.fragment);
    stages.push_back(fragment->stage(VK_SHADER_STAGE_FRAGMENT_BIT, constants.info));
  }
  std::vector<VkFormat> colors;
  for (const gpu::Format format : desc.colorFormats) colors.push_back(vulkanFormat(format));
  VkPipelineRenderingCreateInfo targets{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  targets.colorAttachmentCount = static_cast<uint32_t>(colors.size());
  targets.pColorAttachmentFormats = colors.data();
  targets.depthAttachmentFormat = vulkanFormat(desc.depthFormat);

  const VertexInput input(desc);
  const FixedState fixed(desc);
  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &targets};
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input.info;
  info.pInputAssemblyState = &fixed.assembly;
  info.pViewportState = &fixed.viewport;
  info.pRasterizationState = &fixed.raster;
  info.pMultisampleState = &fixed.samples;
  info.pDepthStencilState = &fixed.depth;
  info.pColorBlendState = &fixed.blend;
  info.pDynamicState = &fixed.dynamic;
  info.layout = object.layout;
  check(context.vk.vkCreateGraphicsPipelines(context.device, cache, 1, &info, context.callbacks,
                                             &object.pipeline),
        fmt::format("compiling {} and {}", desc.vertex->name,
                    desc.fragment != nullptr ? desc.fragment->name : "no fragment shader"),
        ErrorId::kShaderRefused);
}

template <typename Desc, typename Make>
PipelineObject makeWhole(Context& context, VkPipelineCache cache, const Desc& desc,
                         PipelineObject object, Make make) {
  try {
    makeLayouts(context, object);
    make(context, cache, desc, object);
  } catch (...) {
    release(context, object);
    throw;
  }
  context.name(VK_OBJECT_TYPE_PIPELINE, object.pipeline, desc.label);
  return object;
}

}  // namespace

PipelineObject makePipeline(Context& context, VkPipelineCache cache,
                            const gpu::ComputePipelineDesc& desc) {
  PipelineObject object;
  object.shaders = {desc.shader, nullptr};
  return makeWhole(context, cache, desc, std::move(object), makeCompute);
}

PipelineObject makePipeline(Context& context, VkPipelineCache cache,
                            const gpu::GraphicsPipelineDesc& desc) {
  PipelineObject object;
  object.shaders = {desc.vertex, desc.fragment};
  return makeWhole(context, cache, desc, std::move(object), makeGraphics);
}

void release(Context& context, PipelineObject& object) {
  context.vk.vkDestroyPipeline(context.device, object.pipeline, context.callbacks);
  context.vk.vkDestroyPipelineLayout(context.device, object.layout, context.callbacks);
  context.vk.vkDestroyDescriptorSetLayout(context.device, object.setLayout, context.callbacks);
  object = {};
}

VkDescriptorType descriptorType(uint32_t slotClass) {
  switch (slotClass) {
    case GRISAILLE_SLOT_UNIFORM:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case GRISAILLE_SLOT_STORAGE:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case GRISAILLE_SLOT_TEXTURE:
      return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    default:
      return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  }
}

}  // namespace grisaille::vulkan
