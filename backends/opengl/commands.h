// SPDX-License-Identifier: MIT
// Records commands on OpenGL: each call runs at once, in the device's context.
#pragma once

#include "backends/opengl/context.h"
#include "backends/opengl/resources.h"
#include "backends/opengl/timing.h"
#include "backends/opengl/uniform_ring.h"
#include "core/gpu/device.h"
#include "core/gpu/transient_pool.h"

namespace grisaille::opengl {

class GlCommands final : public gpu::Commands {
 public:
  GlCommands(Context& context, Resources& resources, PassTimer& timer, uint32_t uniformAlignment);

  // Begin and end a frame. The GPU must have finished the previous frame of this slot.
  void beginFrame(uint32_t slot);
  // See UniformRing::prepare().
  void prepareSlots(uint32_t slots) { uniforms_.prepare(slots); }
  void endFrame();
  // A debug group around passes.
  void openGroup(std::string_view label);
  // Closes all groups that are still open, also that of a pass whose recording failed.
  void closeGroups();

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
  void declareUses(const gpu::Render& render);
  void bindTargets(const gpu::Render& render);
  void draw(const gpu::Draw& draw);
  void bind(const gpu::Shader& shader, std::span<const gpu::Binding> bindings);
  void bindBuffer(uint32_t target, const gpu::Binding& binding);
  void bindImage(const grisaille_shader_slot& slot, const gpu::Binding& binding);

  Context& context_;
  Resources& resources_;
  PassTimer& timer_;
  UniformRing uniforms_;
  gpu::TransientPool transients_;
  uint32_t groups_ = 0;  // number of open debug groups
};

}  // namespace grisaille::opengl
