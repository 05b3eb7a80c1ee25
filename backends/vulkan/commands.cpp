// SPDX-License-Identifier: MIT
#include "backends/vulkan/commands.h"

#include <algorithm>

#include "backends/vulkan/barriers.h"

namespace grisaille::vulkan {
namespace {

using gpu::Access;

VkAttachmentLoadOp loadOp(gpu::Load load) {
  switch (load) {
    case gpu::Load::kClear:
      return VK_ATTACHMENT_LOAD_OP_CLEAR;
    case gpu::Load::kLoad:
      return VK_ATTACHMENT_LOAD_OP_LOAD;
    default:
      return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  }
}

VkCullModeFlags cullMode(gpu::Cull cull) {
  switch (cull) {
    case gpu::Cull::kBack:
      return VK_CULL_MODE_BACK_BIT;
    case gpu::Cull::kFront:
      return VK_CULL_MODE_FRONT_BIT;
    default:
      return VK_CULL_MODE_NONE;
  }
}

VkRect2D scissorOf(const gpu::Scissor& scissor, VkExtent2D whole) {
  if (scissor.width == 0) return {{0, 0}, whole};
  return {{static_cast<int32_t>(scissor.x), static_cast<int32_t>(scissor.y)},
          {scissor.width, scissor.height}};
}

VkClearColorValue clearColor(const std::array<float, 4>& clear, gpu::Format format) {
  VkClearColorValue value{};
  for (size_t i = 0; i < clear.size(); ++i) {
    if (format == gpu::Format::kR32Uint) {
      value.uint32[i] = static_cast<uint32_t>(clear[i]);
    } else {
      value.float32[i] = clear[i];
    }
  }
  return value;
}

}  // namespace

void Recorder::begin(Recording& recording, VkCommandBuffer commands, std::string_view group) {
  recording_ = &recording;
  commands_ = commands;
  pending_ = false;
  labels_ = 0;
  if (!group.empty()) openLabel(group);
}

void Recorder::end() {
  while (labels_ > 0) closeLabel();
  recording_ = nullptr;
}

// Copies the label to an array: recording allocates nothing.
void Recorder::openLabel(std::string_view label) {
  if (context_.debug().beginLabel == nullptr) return;
  std::array<char, 128> text = {};
  std::copy_n(label.begin(), std::min(label.size(), text.size() - 1), text.begin());
  VkDebugUtilsLabelEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
  info.pLabelName = text.data();
  context_.debug().beginLabel(commands(), &info);
  ++labels_;
}

void Recorder::closeLabel() {
  if (labels_ == 0) return;
  context_.debug().endLabel(commands());
  --labels_;
}

void Recorder::endFrame(uint64_t count) {
  transients_.endFrame([&](gpu::Texture texture) { resources_.retire(texture, count); });
}

void Recorder::submitAndWait() {
  if (!pending_) return;
  drain_();
  pending_ = false;
}

void Recorder::beginPass(std::string_view label) {
  if (recording_->timer.wall()) submitAndWait();
  recording_->timer.beginPass(commands(), label);
  openLabel(label);
}

void Recorder::endPass() {
  closeLabel();
  if (recording_->timer.wall()) submitAndWait();
  recording_->timer.endPass(commands());
}

// --- Dispatch ------------------------------------------------------------------------------------

void Recorder::declare(const PipelineObject& pipeline, std::span<const gpu::Binding> bindings,
                       std::span<const gpu::Texture> general) {
  gpu::StateTracker& tracker = resources_.tracker();
  for (const gpu::Shader* shader : pipeline.shaders) {
    if (shader != nullptr) tracker.use(*shader, bindings);
  }
  if (general.empty()) return;
  for (const grisaille_shader_slot* slot : pipeline.slots) {
    if (slot->slot_class != GRISAILLE_SLOT_TEXTURE) continue;
    for (const gpu::Binding& binding : bindings) {
      const bool here = binding.slotClass == slot->slot_class && binding.slot == slot->slot;
      if (here &&
          std::find(general.begin(), general.end(), binding.view.texture) != general.end()) {
        tracker.use(binding.view, Access::kSampled | Access::kStorageRead);
      }
    }
  }
}

void Recorder::dispatch(const gpu::Dispatch& dispatch) {
  const PipelineObject& pipeline = resources_.get(dispatch.pipeline);
  const BoundCall call{&pipeline, dispatch.bindings};
  const std::vector<gpu::Texture> general = readBothWays(resources_, {&call, 1});
  const VkDescriptorSet set =
      writeSet(context_, resources_, recording_->descriptors, call, general);
  declare(pipeline, dispatch.bindings, general);
  resources_.recordBarriers(commands());

  const VolkDeviceTable& vk = context_.vk;
  vk.vkCmdBindPipeline(commands(), VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline);
  vk.vkCmdBindDescriptorSets(commands(), VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1,
                             &set, 0, nullptr);
  vk.vkCmdDispatch(commands(), dispatch.groups[0], dispatch.groups[1], dispatch.groups[2]);
  pending_ = true;
}

// --- Render --------------------------------------------------------------------------------------

gpu::TextureView Recorder::targetView(gpu::TextureView view) {
  view.mipCount = view.layerCount = 1;
  return resources_.resolve(view);
}

Recorder::Targets Recorder::targetsOf(const gpu::Render& render) {
  Targets targets;
  const auto attach = [&](const gpu::TextureView& given, gpu::Load load) {
    const gpu::TextureView view = targetView(given);
    const gpu::TextureDesc& desc = resources_.get(view.texture).desc;
    targets.extent = {std::max(1u, desc.width >> view.mip), std::max(1u, desc.height >> view.mip)};
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = resources_.viewOf(view, VK_IMAGE_VIEW_TYPE_2D);
    info.imageLayout = layoutOf(Access::kColorTarget);
    info.loadOp = loadOp(load);
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
  };
  for (const gpu::ColorTarget& color : render.colors) {
    VkRenderingAttachmentInfo info = attach(color.view, color.load);
    info.clearValue.color = clearColor(color.clear, resources_.get(color.view.texture).desc.format);
    targets.colors.push_back(info);
  }
  targets.hasDepth = static_cast<bool>(render.depth.view.texture);
  if (targets.hasDepth) {
    targets.depth = attach(render.depth.view, render.depth.load);
    targets.depth.clearValue.depthStencil = {render.depth.clear, 0};
  }
  return targets;
}

void Recorder::declareRender(const gpu::Render& render, std::span<const gpu::Texture> general) {
  gpu::StateTracker& tracker = resources_.tracker();
  for (const gpu::ColorTarget& color : render.colors) {
    tracker.use(targetView(color.view), Access::kColorTarget);
  }
  if (render.depth.view.texture) tracker.use(targetView(render.depth.view), Access::kDepthTarget);
  for (const gpu::Draw& draw : render.draws) {
    declare(resources_.get(draw.pipeline), draw.bindings, general);
    for (const gpu::BufferRange& stream : draw.vertexStreams) {
      tracker.use(stream.buffer, Access::kVertex);
    }
    if (draw.indices.buffer) tracker.use(draw.indices.buffer, Access::kIndex);
  }
}

// Everything that may throw runs before the first use is declared. The barriers come before
// vkCmdBeginRendering(), because a rendering scope cannot contain them.
void Recorder::render(const gpu::Render& render) {
  const Targets targets = targetsOf(render);
  std::vector<BoundCall> calls;
  for (const gpu::Draw& draw : render.draws) {
    calls.push_back({&resources_.get(draw.pipeline), draw.bindings});
    for (const gpu::BufferRange& stream : draw.vertexStreams) resources_.resolve(stream);
    if (draw.indices.buffer) resources_.resolve(draw.indices);
  }
  const std::vector<gpu::Texture> general = readBothWays(resources_, calls);
  std::vector<VkDescriptorSet> sets;
  for (const BoundCall& call : calls) {
    sets.push_back(writeSet(context_, resources_, recording_->descriptors, call, general));
  }
  declareRender(render, general);
  resources_.recordBarriers(commands());
  beginRendering(targets);
  drawAll(render, targets, sets);
  context_.vk.vkCmdEndRendering(commands());
  pending_ = true;
}

void Recorder::beginRendering(const Targets& targets) {
  const VolkDeviceTable& vk = context_.vk;
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea.extent = targets.extent;
  info.layerCount = 1;
  info.colorAttachmentCount = static_cast<uint32_t>(targets.colors.size());
  info.pColorAttachments = targets.colors.data();
  if (targets.hasDepth) info.pDepthAttachment = &targets.depth;
  vk.vkCmdBeginRendering(commands(), &info);
  // Negative height makes y point up in clip space.
  const float width = static_cast<float>(targets.extent.width);
  const float height = static_cast<float>(targets.extent.height);
  const VkViewport viewport{0, height, width, -height, 0, 1};
  vk.vkCmdSetViewport(commands(), 0, 1, &viewport);
}

void Recorder::bindVertices(const gpu::Draw& draw) {
  std::array<VkBuffer, gpu::kMaxVertexStreams> buffers{};
  std::array<VkDeviceSize, gpu::kMaxVertexStreams> offsets{};
  const size_t count = std::min<size_t>(draw.vertexStreams.size(), buffers.size());
  for (size_t i = 0; i < count; ++i) {
    buffers[i] = resources_.get(draw.vertexStreams[i].buffer).buffer;
    offsets[i] = draw.vertexStreams[i].offset;
  }
  if (count > 0) {
    context_.vk.vkCmdBindVertexBuffers(commands(), 0, static_cast<uint32_t>(count), buffers.data(),
                                       offsets.data());
  }
}

void Recorder::drawAll(const gpu::Render& render, const Targets& targets,
                       std::span<const VkDescriptorSet> sets) {
  const VolkDeviceTable& vk = context_.vk;
  for (size_t i = 0; i < render.draws.size(); ++i) {
    const gpu::Draw& draw = render.draws[i];
    const PipelineObject& pipeline = resources_.get(draw.pipeline);
    if (i == 0 || draw.pipeline != render.draws[i - 1].pipeline) {
      vk.vkCmdBindPipeline(commands(), VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline);
    }
    vk.vkCmdBindDescriptorSets(commands(), VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout, 0, 1,
                               &sets[i], 0, nullptr);
    vk.vkCmdSetCullMode(commands(), cullMode(draw.cull));
    const VkRect2D scissor = scissorOf(draw.scissor, targets.extent);
    vk.vkCmdSetScissor(commands(), 0, 1, &scissor);
    bindVertices(draw);
    if (draw.indices.buffer) {
      vk.vkCmdBindIndexBuffer(commands(), resources_.get(draw.indices.buffer).buffer,
                              draw.indices.offset, VK_INDEX_TYPE_UINT32);
      vk.vkCmdDrawIndexed(commands(), draw.count, 1, draw.first, 0, 0);
    } else {
      vk.vkCmdDraw(commands(), draw.count, 1, draw.first, 0);
    }
  }
}

// --- Data ----------------------------------------------------------------------------------------

gpu::BufferRange Recorder::uniform(std::span<const std::byte> bytes) {
  return recording_->arena.copy(bytes);
}

gpu::Texture Recorder::transient(const gpu::TextureDesc& desc) {
  return transients_.take(desc, [this](const gpu::TextureDesc& d) { return resources_.add(d); });
}

void Recorder::upload(gpu::Buffer buffer, uint64_t offset, std::span<const std::byte> bytes) {
  const VkBuffer target = resources_.get(buffer).buffer;
  const gpu::BufferRange from = recording_->arena.copy(bytes);
  resources_.tracker().use(buffer, Access::kCopyWrite);
  resources_.recordBarriers(commands());
  const VkBufferCopy region{from.offset, offset, bytes.size()};
  context_.vk.vkCmdCopyBuffer(commands(), resources_.get(from.buffer).buffer, target, 1, &region);
  pending_ = true;
}

void Recorder::upload(gpu::Texture texture, uint32_t mip, uint32_t layer,
                      std::span<const std::byte> bytes) {
  const gpu::TextureView view = resources_.resolve(gpu::TextureView{
      .texture = texture, .mip = mip, .mipCount = 1, .layer = layer, .layerCount = 1});
  const TextureObject& target = resources_.get(texture);
  const gpu::BufferRange from = recording_->arena.copy(bytes);
  resources_.tracker().use(view, Access::kCopyWrite);
  resources_.recordBarriers(commands());
  const VkBufferImageCopy region = copyRegion(target.desc, mip, layer, from.offset);
  context_.vk.vkCmdCopyBufferToImage(commands(), resources_.get(from.buffer).buffer, target.image,
                                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  pending_ = true;
}

}  // namespace grisaille::vulkan
