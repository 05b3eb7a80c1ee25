// SPDX-License-Identifier: MIT
// Records a frame's calls.
#pragma once

#include <functional>

#include "backends/vulkan/frame.h"
#include "core/gpu/transient_pool.h"

namespace grisaille::vulkan {

class Recorder : public gpu::Commands {
 public:
  // `drain` submits what is recorded, waits for it and begins the command buffer anew: for wall
  // clocks, which not every device has.
  Recorder(Context& context, Resources& resources, std::function<void()> drain)
      : context_(context), resources_(resources), drain_(std::move(drain)) {}

  void begin(Recording& recording, VkCommandBuffer commands);
  void end() { recording_ = nullptr; }
  bool recording() const { return recording_ != nullptr; }

  // The transient textures may be handed out again. `count` as Resources::retire() has it, of the
  // last frame.
  void endFrame(uint64_t count);

  void beginPass(std::string_view label) override;
  void endPass() override;
  void render(const gpu::Render& render) override;
  void dispatch(const gpu::Dispatch& dispatch) override;
  gpu::BufferRange uniform(std::span<const std::byte> bytes) override;
  gpu::Texture transient(const gpu::TextureDesc& desc) override;
  void upload(gpu::Buffer buffer, uint64_t offset, std::span<const std::byte> bytes) override;
  void upload(gpu::Texture texture, uint32_t mip, uint32_t layer,
              std::span<const std::byte> bytes) override;

 private:
  // The targets of a render call as dynamic rendering wants them.
  struct Targets {
    std::vector<VkRenderingAttachmentInfo> colors;
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    bool hasDepth = false;
    VkExtent2D extent{};
  };

  VkCommandBuffer commands() const { return commands_; }
  void submitAndWait();

  Targets targetsOf(const gpu::Render& render);
  gpu::TextureView targetView(gpu::TextureView view);
  void declare(const PipelineObject& pipeline, std::span<const gpu::Binding> bindings,
               std::span<const gpu::Texture> general);
  void declareRender(const gpu::Render& render, std::span<const gpu::Texture> general);
  void beginRendering(const Targets& targets);
  void bindVertices(const gpu::Draw& draw);
  void drawAll(const gpu::Render& render, const Targets& targets,
               std::span<const VkDescriptorSet> sets);

  Context& context_;
  Resources& resources_;
  std::function<void()> drain_;
  gpu::TransientPool transients_;
  Recording* recording_ = nullptr;  // null: not recording
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  bool pending_ = false;  // something is recorded that is not submitted
};

}  // namespace grisaille::vulkan
