// SPDX-License-Identifier: MIT
// A device in another program's context. It restores the state of the context after recording.
#include <epoxy/gl.h>

#include <optional>
#include <vector>

#include "backends/opengl/adapters.h"
#include "backends/opengl/commands.h"
#include "backends/opengl/current_context.h"
#include "backends/opengl/formats.h"
#include "backends/opengl/host_state.h"
#include "backends/opengl/info.h"
#include "backends/opengl/opengl.h"
#include "backends/opengl/pipelines.h"
#include "core/base/error.h"

namespace grisaille::opengl {
namespace {

int ofTexture(GLuint name, GLenum what) {
  GLint value = 0;
  glGetTextureParameteriv(name, what, &value);
  return value;
}

int ofLevel(GLuint name, GLenum what) {
  GLint value = 0;
  glGetTextureLevelParameteriv(name, 0, what, &value);
  return value;
}

bool sampledAsFloat(int type) {
  return type == GL_FLOAT || type == GL_UNSIGNED_NORMALIZED || type == GL_SIGNED_NORMALIZED;
}

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
    return resources_.createBuffer(desc);
  }
  gpu::Texture createTexture(const gpu::TextureDesc& desc) override {
    return resources_.createTexture(desc);
  }
  gpu::Sampler createSampler(const gpu::SamplerDesc& desc) override {
    return resources_.createSampler(desc);
  }
  gpu::ComputePipeline createComputePipeline(const gpu::ComputePipelineDesc& desc) override {
    return resources_.computePipelines.add(buildCompute(desc));
  }
  gpu::GraphicsPipeline createGraphicsPipeline(const gpu::GraphicsPipelineDesc& desc) override {
    return resources_.graphicsPipelines.add(buildGraphics(desc));
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
  gpu::Commands& begin(void* commandBuffer, uint64_t frame,
                       std::span<const gpu::Texture> reads) override;
  void end(std::span<const gpu::Texture> writes) override;
  void forget(gpu::Texture) override {}  // commands run at once: nothing can be dropped
  void forgetTransients() override {}
  gpu::NativeTexture native(gpu::Texture texture) override;
  void requireUsable() const override;

 private:
  void turnTo(uint64_t frame);

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
  const auto name = static_cast<GLuint>(texture.name);
  if (texture.name != name || glIsTexture(name) == GL_FALSE) {
    throw Error(ErrorId::kHostTexture, "{} names no texture", texture.name);
  }
  if (ofTexture(name, GL_TEXTURE_TARGET) != GL_TEXTURE_2D) {
    throw Error(ErrorId::kHostTexture, "texture {} is not a 2D texture", name);
  }
  const bool depth = ofLevel(name, GL_TEXTURE_DEPTH_SIZE) > 0;
  if (!sampledAsFloat(ofLevel(name, depth ? GL_TEXTURE_DEPTH_TYPE : GL_TEXTURE_RED_TYPE))) {
    throw Error(ErrorId::kHostTexture, "texture {} is not sampled as floats", name);
  }
  const auto width = static_cast<uint32_t>(ofLevel(name, GL_TEXTURE_WIDTH));
  const auto height = static_cast<uint32_t>(ofLevel(name, GL_TEXTURE_HEIGHT));
  const bool given = texture.width != 0 || texture.height != 0;
  if (given && (texture.width != width || texture.height != height)) {
    throw Error(ErrorId::kHostTexture, "texture {} has {} x {} pixels, not {} x {}", name, width,
                height, texture.width, texture.height);
  }
  TextureResource resource;
  resource.object = Object::foreign(name);
  resource.desc = {.format = gpu::Format::kRgba32Float,
                   .width = width,
                   .height = height,
                   .usage = gpu::TextureUsage::kSampled};
  return resources_.textures.add(std::move(resource));
}

gpu::ForeignInfo GlHostDevice::foreign(gpu::Texture texture) {
  const TextureResource& resource = resources_.textures.get(texture);
  const GLuint name = resource.object.name();
  uint32_t channels = 0;
  for (const GLenum size :
       {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE}) {
    if (ofLevel(name, size) > 0) ++channels;
  }
  return {.width = resource.desc.width,
          .height = resource.desc.height,
          .channels = channels,
          .depth = ofLevel(name, GL_TEXTURE_DEPTH_SIZE) > 0};
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

gpu::Commands& GlHostDevice::begin(void* commandBuffer, uint64_t frame,
                                   std::span<const gpu::Texture>) {
  if (commandBuffer != nullptr) {
    throw Error(ErrorId::kHostFrame, "OpenGL takes no command buffer, but one was given");
  }
  turnTo(frame);
  if (!spec_.keepsState) state_.save();
  HostState::prepare();
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  return commands_;
}

void GlHostDevice::end(std::span<const gpu::Texture> writes) {
  for (const gpu::Texture texture : writes) {
    resources_.tracker.use(gpu::TextureView{.texture = texture}, gpu::Access::kSampled);
  }
  resources_.barriers();
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
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
