// SPDX-License-Identifier: MIT
// A device in another program's context. It restores the state of the context after recording.
#include <epoxy/gl.h>

#include <optional>
#include <vector>

#include "backends/opengl/adapters.h"
#include "backends/opengl/commands.h"
#include "backends/opengl/current_context.h"
#include "backends/opengl/foreign.h"
#include "backends/opengl/formats.h"
#include "backends/opengl/host_state.h"
#include "backends/opengl/info.h"
#include "backends/opengl/opengl.h"
#include "backends/opengl/pipelines.h"
#include "core/base/error.h"

namespace grisaille::opengl {
namespace {

// Whether the GPU has finished the commands before a fence, as far as the driver knows. Does not
// wait.
bool isDone(GLsync fence) {
  if (fence == nullptr) return true;
  GLint status = GL_UNSIGNALED;
  glGetSynciv(fence, GL_SYNC_STATUS, 1, nullptr, &status);
  return status == GL_SIGNALED;
}

class GlHostDevice final : public gpu::HostDevice {
 public:
  GlHostDevice(const Adapter& adapter, const HostSpec& spec)
      : spec_(spec),
        current_(currentContext()),
        info_(readInfo(adapter.listed)),
        timer_(gpu::Clock::kNone),
        commands_(context_, resources_, timer_, info_.capabilities.uniformAlignment),
        // One more than the frames in flight: the frame that is recorded.
        fences_(spec.framesInFlight + 1, nullptr) {}
  ~GlHostDevice() override {
    for (const GLsync fence : fences_) glDeleteSync(fence);  // ignores null
  }

  const gpu::DeviceInfo& info() const override { return info_; }

  gpu::Buffer createBuffer(const gpu::BufferDesc& desc) override {
    const gpu::Buffer buffer = resources_.createBuffer(desc);
    name(resources_.buffers.get(buffer).object, desc.label);
    return buffer;
  }
  gpu::Texture createTexture(const gpu::TextureDesc& desc) override {
    const gpu::Texture texture = resources_.createTexture(desc);
    name(resources_.textures.get(texture).object, desc.label);
    return texture;
  }
  gpu::Sampler createSampler(const gpu::SamplerDesc& desc) override {
    const gpu::Sampler sampler = resources_.createSampler(desc);
    name(resources_.samplers.get(sampler).object, desc.label);
    return sampler;
  }
  gpu::ComputePipeline createComputePipeline(const gpu::ComputePipelineDesc& desc) override {
    ComputePipelineResource pipeline = buildCompute(desc);
    name(pipeline.program, desc.label);
    return resources_.computePipelines.add(std::move(pipeline));
  }
  gpu::GraphicsPipeline createGraphicsPipeline(const gpu::GraphicsPipelineDesc& desc) override {
    GraphicsPipelineResource pipeline = buildGraphics(desc);
    name(pipeline.program, desc.label);
    return resources_.graphicsPipelines.add(std::move(pipeline));
  }
  void destroy(gpu::Buffer buffer) override {
    if (buffer) resources_.destroy(buffer);
  }
  void destroy(gpu::Texture texture) override {
    if (texture) resources_.destroy(texture);
  }
  void destroy(gpu::Sampler sampler) override {
    if (sampler) resources_.samplers.remove(sampler);
  }
  void destroy(gpu::ComputePipeline pipeline) override {
    if (pipeline) resources_.computePipelines.remove(pipeline);
  }
  void destroy(gpu::GraphicsPipeline pipeline) override {
    if (pipeline) resources_.graphicsPipelines.remove(pipeline);
  }

  gpu::Texture wrap(const gpu::ForeignTexture& texture) override;
  gpu::ForeignInfo foreign(gpu::Texture texture) override;
  gpu::Commands& begin(void* commandBuffer, uint64_t frame, std::span<const gpu::Texture> reads,
                       std::string_view label) override;
  void end(std::span<const gpu::Texture> writes) override;
  void forget(gpu::Texture) override {}  // commands run at once: nothing can be dropped
  gpu::MemoryUse memory() const override { return resources_.use(); }
  uint64_t bytesOf(const gpu::TextureDesc& desc) const override { return opengl::bytesOf(desc); }
  uint64_t bytesOf(const gpu::BufferDesc& desc) const override { return desc.size; }
  gpu::NativeTexture native(gpu::Texture texture) override;
  void requireUsable() const override;

 private:
  void turnTo(uint64_t frame);
  static void name(const Object& object, std::string_view label);

  const HostSpec spec_;
  void* current_;  // the context
  Context context_;
  gpu::DeviceInfo info_;
  HostState state_;
  Resources resources_;
  PassTimer timer_;
  GlCommands commands_;
  std::vector<GLsync> fences_;     // by slot: of its last frame; null: none
  std::optional<uint64_t> frame_;  // number of the last frame
  uint32_t slot_ = 0;              // of that frame
};

void GlHostDevice::requireUsable() const {
  void* const now = currentContext();
  if (now == current_) return;
  throw Error(ErrorId::kHostContext, "{} is current",
              now == nullptr ? "no OpenGL context" : "another OpenGL context");
}

gpu::Texture GlHostDevice::wrap(const gpu::ForeignTexture& texture) {
  return resources_.textures.add(wrapForeign(texture));
}

gpu::ForeignInfo GlHostDevice::foreign(gpu::Texture texture) {
  return describeForeign(resources_.textures.get(texture));
}

// Starts a frame in a slot whose last frame the GPU has finished. Without one, adds a slot: the
// library does not wait.
void GlHostDevice::turnTo(uint64_t frame) {
  if (frame_ && frame < *frame_) {
    throw Error(ErrorId::kHostFrame, "frame {} follows frame {}; numbers must not fall", frame,
                *frame_);
  }
  if (frame_ == frame) return;
  if (frame_) commands_.endFrame();
  frame_ = frame;
  // The oldest frame's slot is the first to be free.
  const auto count = static_cast<uint32_t>(fences_.size());
  uint32_t slot = count;
  for (uint32_t i = 1; i <= count && slot == count; ++i) {
    if (isDone(fences_[(slot_ + i) % count])) slot = (slot_ + i) % count;
  }
  if (slot == count) fences_.push_back(nullptr);
  slot_ = slot;
  commands_.beginFrame(slot_);
}

// Names an object among those of the program.
void GlHostDevice::name(const Object& object, std::string_view label) {
  if (!label.empty()) object.label(fmt::format("grisaille: {}", label));
}

gpu::Commands& GlHostDevice::begin(void* commandBuffer, uint64_t frame,
                                   std::span<const gpu::Texture>, std::string_view label) {
  if (commandBuffer != nullptr) {
    throw Error(ErrorId::kHostFrame, "OpenGL takes no command buffer, but one was given");
  }
  turnTo(frame);
  if (!spec_.keepsState) state_.save();
  HostState::prepare();
  if (!label.empty()) commands_.openGroup(label);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  return commands_;
}

void GlHostDevice::end(std::span<const gpu::Texture> writes) {
  for (const gpu::Texture texture : writes) {
    resources_.tracker.use(gpu::TextureView{.texture = texture}, gpu::Access::kSampled);
  }
  resources_.barriers();
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  commands_.closeGroups();
  commands_.prepareSlots(static_cast<uint32_t>(fences_.size()));
  GLsync& fence = fences_[slot_];
  glDeleteSync(fence);
  fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!spec_.keepsState) state_.restore();
}

gpu::NativeTexture GlHostDevice::native(gpu::Texture texture) {
  const TextureResource& resource = resources_.textures.get(texture);
  return {.name = resource.object.name(),
          .view = 0,
          .format = glFormat(resource.desc.format).internalFormat,
          .layout = 0};
}

}  // namespace

std::unique_ptr<gpu::HostDevice> createHostDevice(const HostSpec& spec) {
  if (currentContext() == nullptr) {
    throw Error(ErrorId::kHostContext, "no OpenGL context is current on this thread");
  }
  const Adapter adapter = currentAdapter();
  if (!epoxy_is_desktop_gl() || adapter.version < 45) {
    throw Error(ErrorId::kDeviceTooOld, "{} has OpenGL{} {}.{} in this context, and 4.5 is needed",
                adapter.listed.name, epoxy_is_desktop_gl() ? "" : " ES", adapter.version / 10,
                adapter.version % 10);
  }
  return std::make_unique<GlHostDevice>(adapter, spec);
}

}  // namespace grisaille::opengl
