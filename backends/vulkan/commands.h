// SPDX-License-Identifier: MIT
// Records a frame's commands into a command buffer.
#pragma once

#include <functional>

#include "backends/vulkan/frame.h"
#include "core/gpu/transient_pool.h"

namespace grisaille::vulkan {

class Recorder : public gpu::Commands {
 public:
  // `drain` submits the recorded commands, waits for them and begins the command buffer again. Only
  // timing by the wall clock calls it; it may be empty if the device never uses that clock.
  Recorder(Context& context, Resources& resources, std::function<void()> drain)
      : context_(context), resources_(resources), drain_(std::move(drain)) {}

  // `group`: label around all passes; "": none.
  void begin(Recording& recording, VkCommandBuffer commands, std::string_view group = "");
  // Closes the labels that are still open: of a pass, if its recording failed.
  void end();
  bool recording() const { return recording_ != nullptr; }

  // Makes the transient textures available again. `count`: the last frame's, as in
  // Resources::retire().
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
  // The targets of a render call in the form that dynamic rendering takes.
  struct Targets {
    std::vector<VkRenderingAttachmentInfo> colors;
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    bool hasDepth = false;
    VkExtent2D extent{};
  };

  VkCommandBuffer commands() const { return commands_; }
  void submitAndWait();
  void openLabel(std::string_view label);
  void closeLabel();

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
  bool pending_ = false;  // commands are recorded that are not submitted
  uint32_t labels_ = 0;   // number of open debug labels
};

}  // namespace grisaille::vulkan
