// SPDX-License-Identifier: MIT
#include "renderer.h"

#include <cstring>

#include "scene.h"

namespace example {
namespace {

constexpr uint32_t kSceneVert[] =
#include "scene.vert.inc"
    ;
constexpr uint32_t kSceneFrag[] =
#include "scene.frag.inc"
    ;
constexpr uint32_t kLightComp[] =
#include "light.comp.inc"
    ;

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule module) {
  VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage = bit;
  info.module = module;
  info.pName = "main";
  return info;
}

VkRenderingAttachmentInfo attachment(const Image& image) {
  VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  info.imageView = image.view;
  info.imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  return info;
}

}  // namespace

glm::mat4 clipFromView() {
  const float scale = 1 / std::tan(kAngle / 2);
  glm::mat4 clip(0.0f);
  clip[0][0] = scale * static_cast<float>(kHeight) / static_cast<float>(kWidth);
  clip[1][1] = -scale;
  clip[2][2] = kNear / (kFar - kNear);
  clip[3][2] = kNear * kFar / (kFar - kNear);
  clip[2][3] = -1;
  return clip;
}

Renderer::Renderer(Context& context) : context_(context) {
  constexpr VkImageUsageFlags kReadBack =
      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  depth = context.makeImage(VK_FORMAT_D32_SFLOAT, kWidth, kHeight,
                            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | kReadBack);
  normal = context.makeImage(VK_FORMAT_R16G16B16A16_SFLOAT, kWidth, kHeight,
                             VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | kReadBack);
  colour = context.makeImage(
      VK_FORMAT_R16G16B16A16_SFLOAT, kWidth, kHeight,
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT | kReadBack);
  const std::vector<Vertex> scene = example::scene();
  vertexCount_ = static_cast<uint32_t>(scene.size());
  vertices_ = context.makeBuffer(scene.size() * sizeof(Vertex), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  std::memcpy(vertices_.mapped, scene.data(), scene.size() * sizeof(Vertex));
  makeScenePipeline();
  makeLightPipeline();
  makeFrames();
}

Renderer::~Renderer() {
  const VkDevice device = context_.device;
  vkDeviceWaitIdle(device);
  for (const Frame& frame : frames_) {
    vkDestroyFence(device, frame.done, nullptr);
    vkDestroyCommandPool(device, frame.pool, nullptr);
  }
  vkDestroyDescriptorPool(device, sets_, nullptr);
  vkDestroyPipeline(device, scenePipeline_, nullptr);
  vkDestroyPipeline(device, lightPipeline_, nullptr);
  vkDestroyPipelineLayout(device, sceneLayout_, nullptr);
  vkDestroyPipelineLayout(device, lightLayout_, nullptr);
  vkDestroyDescriptorSetLayout(device, setLayout_, nullptr);
  vkDestroySampler(device, nearest_, nullptr);
  context_.destroy(vertices_);
  for (Image* image : {&depth, &normal, &colour}) context_.destroy(*image);
}

void Renderer::makeScenePipeline() {
  const VkPushConstantRange camera = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(glm::mat4)};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &camera;
  check(vkCreatePipelineLayout(context_.device, &layout, nullptr, &sceneLayout_), "a layout");

  const VkShaderModule vertex = context_.makeShader(kSceneVert);
  const VkShaderModule fragment = context_.makeShader(kSceneFrag);
  const VkPipelineShaderStageCreateInfo stages[] = {stage(VK_SHADER_STAGE_VERTEX_BIT, vertex),
                                                    stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
  const VkVertexInputBindingDescription stream = {0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
  const VkVertexInputAttributeDescription attributes[] = {
      {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
      {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)}};
  VkPipelineVertexInputStateCreateInfo input{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  input.vertexBindingDescriptionCount = 1;
  input.pVertexBindingDescriptions = &stream;
  input.vertexAttributeDescriptionCount = 2;
  input.pVertexAttributeDescriptions = attributes;
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  const VkViewport viewport = {0, 0, kWidth, kHeight, 0, 1};
  const VkRect2D scissor = {{0, 0}, {kWidth, kHeight}};
  VkPipelineViewportStateCreateInfo view{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  view.viewportCount = view.scissorCount = 1;
  view.pViewports = &viewport;
  view.pScissors = &scissor;
  VkPipelineRasterizationStateCreateInfo raster{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo test{
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  test.depthTestEnable = test.depthWriteEnable = VK_TRUE;
  test.depthCompareOp = VK_COMPARE_OP_GREATER;
  VkPipelineColorBlendAttachmentState written[2] = {};
  for (VkPipelineColorBlendAttachmentState& one : written) one.colorWriteMask = 0xf;
  VkPipelineColorBlendStateCreateInfo blend{
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = 2;
  blend.pAttachments = written;
  const VkFormat formats[] = {colour.format, normal.format};
  VkPipelineRenderingCreateInfo targets{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  targets.colorAttachmentCount = 2;
  targets.pColorAttachmentFormats = formats;
  targets.depthAttachmentFormat = depth.format;
  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &targets};
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &view;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &test;
  info.pColorBlendState = &blend;
  info.layout = sceneLayout_;
  check(vkCreateGraphicsPipelines(context_.device, VK_NULL_HANDLE, 1, &info, nullptr,
                                  &scenePipeline_),
        "a graphics pipeline");
  vkDestroyShaderModule(context_.device, vertex, nullptr);
  vkDestroyShaderModule(context_.device, fragment, nullptr);
}

void Renderer::makeLightPipeline() {
  VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  check(vkCreateSampler(context_.device, &sampler, nullptr, &nearest_), "a sampler");
  const VkDescriptorSetLayoutBinding bindings[] = {
      {0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
      {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_COMPUTE_BIT, &nearest_}};
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.bindingCount = 2;
  set.pBindings = bindings;
  check(vkCreateDescriptorSetLayout(context_.device, &set, nullptr, &setLayout_), "a set layout");
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &setLayout_;
  check(vkCreatePipelineLayout(context_.device, &layout, nullptr, &lightLayout_), "a layout");
  const VkShaderModule module = context_.makeShader(kLightComp);
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, module);
  info.layout = lightLayout_;
  check(
      vkCreateComputePipelines(context_.device, VK_NULL_HANDLE, 1, &info, nullptr, &lightPipeline_),
      "a compute pipeline");
  vkDestroyShaderModule(context_.device, module, nullptr);
}

void Renderer::makeFrames() {
  const VkDescriptorPoolSize sizes[] = {
      {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kFramesInFlight},
      {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFramesInFlight}};
  VkDescriptorPoolCreateInfo sets{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  sets.maxSets = kFramesInFlight;
  sets.poolSizeCount = 2;
  sets.pPoolSizes = sizes;
  check(vkCreateDescriptorPool(context_.device, &sets, nullptr, &sets_), "a descriptor pool");
  for (Frame& frame : frames_) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = context_.family;
    check(vkCreateCommandPool(context_.device, &pool, nullptr, &frame.pool), "a command pool");
    VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    commands.commandPool = frame.pool;
    commands.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(context_.device, &commands, &frame.commands), "commands");
    VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    check(vkCreateFence(context_.device, &fence, nullptr, &frame.done), "a fence");
    VkDescriptorSetAllocateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    set.descriptorPool = sets_;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &setLayout_;
    check(vkAllocateDescriptorSets(context_.device, &set, &frame.set), "a descriptor set");
  }
}

VkCommandBuffer Renderer::begin(uint64_t number) {
  frame_ = &frames_[number % kFramesInFlight];
  check(vkWaitForFences(context_.device, 1, &frame_->done, VK_TRUE, UINT64_MAX), "a frame");
  check(vkResetFences(context_.device, 1, &frame_->done), "vkResetFences");
  check(vkResetCommandPool(context_.device, frame_->pool, 0), "vkResetCommandPool");
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(frame_->commands, &info), "vkBeginCommandBuffer");
  return frame_->commands;
}

void Renderer::drawScene(VkCommandBuffer commands) {
  for (const Image* image : {&colour, &normal, &depth}) {
    transition(commands, image->image, image->aspect, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
  }
  const VkRenderingAttachmentInfo colours[] = {attachment(colour), attachment(normal)};
  const VkRenderingAttachmentInfo far = attachment(depth);  // cleared to 0
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea.extent = {kWidth, kHeight};
  info.layerCount = 1;
  info.colorAttachmentCount = 2;
  info.pColorAttachments = colours;
  info.pDepthAttachment = &far;
  vkCmdBeginRendering(commands, &info);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, scenePipeline_);
  const glm::mat4 camera = clipFromView() * viewFromWorld();
  vkCmdPushConstants(commands, sceneLayout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(camera),
                     &camera);
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices_.buffer, &offset);
  vkCmdDraw(commands, vertexCount_, 1, 0, 0);
  vkCmdEndRendering(commands);
  for (const Image* image : {&normal, &depth}) {
    transition(commands, image->image, image->aspect, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
  transition(commands, colour.image, colour.aspect, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
             VK_IMAGE_LAYOUT_GENERAL);
}

void Renderer::light(VkCommandBuffer commands, VkImageView visibility, VkImageLayout layout) {
  const VkDescriptorImageInfo images[] = {{VK_NULL_HANDLE, colour.view, VK_IMAGE_LAYOUT_GENERAL},
                                          {nearest_, visibility, layout}};
  VkWriteDescriptorSet writes[2] = {{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET},
                                    {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}};
  for (uint32_t i = 0; i < 2; ++i) {
    writes[i].dstSet = frame_->set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].pImageInfo = &images[i];
  }
  writes[0].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  writes[1].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  vkUpdateDescriptorSets(context_.device, 2, writes, 0, nullptr);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, lightPipeline_);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, lightLayout_, 0, 1,
                          &frame_->set, 0, nullptr);
  vkCmdDispatch(commands, (kWidth + 7) / 8, (kHeight + 7) / 8, 1);
}

void Renderer::submit() {
  check(vkEndCommandBuffer(frame_->commands), "vkEndCommandBuffer");
  VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  info.commandBufferCount = 1;
  info.pCommandBuffers = &frame_->commands;
  check(vkQueueSubmit(context_.queue, 1, &info, frame_->done), "vkQueueSubmit");
}

std::vector<std::byte> Renderer::read(VkImage image, VkImageAspectFlags aspect,
                                      VkImageLayout layout, uint32_t pixelBytes) {
  check(vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
  const size_t bytes = size_t{kWidth} * kHeight * pixelBytes;
  Buffer buffer = context_.makeBuffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const VkCommandBuffer commands = begin(0);
  transition(commands, image, aspect, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  VkBufferImageCopy region{};
  region.imageSubresource = {aspect, 0, 0, 1};
  region.imageExtent = {kWidth, kHeight, 1};
  vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer, 1,
                         &region);
  transition(commands, image, aspect, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout);
  submit();
  check(vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
  const auto* first = static_cast<const std::byte*>(buffer.mapped);
  std::vector<std::byte> content(first, first + bytes);
  context_.destroy(buffer);
  return content;
}

}  // namespace example
