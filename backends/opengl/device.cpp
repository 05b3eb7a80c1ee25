// SPDX-License-Identifier: MIT
#include <epoxy/gl.h>

#include <array>
#include <cstdio>
#include <optional>

#include "backends/opengl/adapters.h"
#include "backends/opengl/commands.h"
#include "backends/opengl/context.h"
#include "backends/opengl/debug_output.h"
#include "backends/opengl/info.h"
#include "backends/opengl/opengl.h"
#include "backends/opengl/pipelines.h"
#include "backends/opengl/readback.h"
#include "backends/opengl/window.h"
#include "core/base/error.h"

namespace grisaille::opengl {
namespace {

// Sets the state that no other call of this backend changes.
void setFixedState() {
  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);  // y up, row 0 on top, depth from 0
  glDepthFunc(GL_GREATER);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_FRAMEBUFFER_SRGB);  // affects sRGB formats only
  glDisable(GL_DITHER);           // on by default; drivers may change bits by it
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

gpu::MessageSink orStandardError(const gpu::MessageSink& sink) {
  if (sink) return sink;
  return [](gpu::Severity, std::string_view line) { fmt::print(stderr, "opengl: {}\n", line); };
}

void requireVersion(const Adapter& adapter) {
  if (adapter.version >= 45) return;
  throw Error(ErrorId::kDeviceTooOld, "{} has OpenGL {}.{}, and 4.5 is needed", adapter.listed.name,
              adapter.version / 10, adapter.version % 10);
}

constexpr uint32_t kFramesInFlight = 2;

class GlDevice final : public gpu::Device {
 public:
  GlDevice(const Adapter& adapter, const gpu::DeviceOptions& options);
  explicit GlDevice(const gpu::DeviceOptions& options);  // uses the context of options.window
  ~GlDevice() override;

  const gpu::DeviceInfo& info() const override { return info_; }

  gpu::Buffer createBuffer(const gpu::BufferDesc& desc) override;
  gpu::Texture createTexture(const gpu::TextureDesc& desc) override;
  gpu::Sampler createSampler(const gpu::SamplerDesc& desc) override;
  gpu::ComputePipeline createComputePipeline(const gpu::ComputePipelineDesc& desc) override;
  gpu::GraphicsPipeline createGraphicsPipeline(const gpu::GraphicsPipelineDesc& desc) override;
  void destroy(gpu::Buffer buffer) override;
  void destroy(gpu::Texture texture) override;
  void destroy(gpu::Sampler sampler) override;
  void destroy(gpu::ComputePipeline pipeline) override;
  void destroy(gpu::GraphicsPipeline pipeline) override;

  gpu::Commands& begin() override;
  void submit() override;
  void abandon() override;
  void wait() override;
  std::vector<std::byte> read(gpu::Texture texture, uint32_t mip, uint32_t layer) override;
  std::vector<std::byte> read(gpu::BufferRange range) override;
  bool present(gpu::Texture texture) override;
  std::vector<gpu::FrameTimes> takeTimes() override;

 private:
  // The objects that need the context, in the order of creation.
  struct Contents {
    Contents(Context& context, const gpu::DeviceInfo& info, gpu::Clock clock)
        : timer(clock), commands(context, resources, timer, info.capabilities.uniformAlignment) {}
    Resources resources;
    PassTimer timer;
    GlCommands commands;
  };

  void start(const gpu::ListedDevice& device, const gpu::DeviceOptions& options);
  uint32_t slot() const { return static_cast<uint32_t>(frame_ % kFramesInFlight); }
  void endFrame();
  void waitForFence(GLsync& fence);
  void throwIfLost();
  void reportErrors();

  gpu::MessageSink sink_;
  bool check_;
  Context context_;
  std::optional<Window> window_;
  gpu::DeviceInfo info_;
  std::optional<Contents> contents_;
  std::array<GLsync, kFramesInFlight> fences_ = {};
  uint64_t frame_ = 0;  // the frame being recorded, else the next frame to begin
  bool recording_ = false;
};

GlDevice::GlDevice(const Adapter& adapter, const gpu::DeviceOptions& options)
    : sink_(orStandardError(options.message)),
      check_(options.check),
      context_(adapter.display, options.check ? ContextKind::kDebug : ContextKind::kCore) {
  context_.makeCurrent();
  start(adapter.listed, options);
}

GlDevice::GlDevice(const gpu::DeviceOptions& options)
    : sink_(orStandardError(options.message)),
      check_(options.check),
      context_(*options.window),
      window_(options.window) {
  const Adapter adapter = currentAdapter();
  requireVersion(adapter);
  requireAdapter(adapter.listed, options.device);
  start(adapter.listed, options);
}

// The context must be current.
void GlDevice::start(const gpu::ListedDevice& device, const gpu::DeviceOptions& options) {
  startDebugOutput(sink_, options.check);
  info_ = readInfo(device);
  setFixedState();
  contents_.emplace(context_, info_, options.timed ? info_.clock : gpu::Clock::kNone);
}

GlDevice::~GlDevice() {
  try {
    context_.makeCurrent();
  } catch (const Error& error) {
    // Another thread holds the context. OpenGL ignores the calls below, and frees the objects with
    // the context.
    sink_(gpu::Severity::kError, error.what());
  }
  glFinish();
  for (const GLsync fence : fences_) glDeleteSync(fence);  // ignores null
  contents_.reset();
  if (window_) stopDebugOutput();  // the window's context outlives the sink
}

gpu::Buffer GlDevice::createBuffer(const gpu::BufferDesc& desc) {
  context_.makeCurrent();
  return contents_->resources.createBuffer(desc);
}

gpu::Texture GlDevice::createTexture(const gpu::TextureDesc& desc) {
  context_.makeCurrent();
  return contents_->resources.createTexture(desc);
}

gpu::Sampler GlDevice::createSampler(const gpu::SamplerDesc& desc) {
  context_.makeCurrent();
  return contents_->resources.createSampler(desc);
}

gpu::ComputePipeline GlDevice::createComputePipeline(const gpu::ComputePipelineDesc& desc) {
  context_.makeCurrent();
  return contents_->resources.computePipelines.add(buildCompute(desc));
}

gpu::GraphicsPipeline GlDevice::createGraphicsPipeline(const gpu::GraphicsPipelineDesc& desc) {
  context_.makeCurrent();
  return contents_->resources.graphicsPipelines.add(buildGraphics(desc));
}

// OpenGL itself keeps objects alive while submitted work uses them.
void GlDevice::destroy(gpu::Buffer buffer) {
  if (!buffer) return;
  context_.makeCurrent();
  contents_->resources.destroy(buffer);
}

void GlDevice::destroy(gpu::Texture texture) {
  if (!texture) return;
  context_.makeCurrent();
  contents_->resources.destroy(texture);
}

void GlDevice::destroy(gpu::Sampler sampler) {
  if (!sampler) return;
  context_.makeCurrent();
  contents_->resources.samplers.remove(sampler);
}

void GlDevice::destroy(gpu::ComputePipeline pipeline) {
  if (!pipeline) return;
  context_.makeCurrent();
  contents_->resources.computePipelines.remove(pipeline);
}

void GlDevice::destroy(gpu::GraphicsPipeline pipeline) {
  if (!pipeline) return;
  context_.makeCurrent();
  contents_->resources.graphicsPipelines.remove(pipeline);
}

gpu::Commands& GlDevice::begin() {
  context_.makeCurrent();
  waitForFence(fences_[slot()]);
  contents_->timer.collect();
  contents_->commands.beginFrame(slot());
  recording_ = true;
  return contents_->commands;
}

void GlDevice::submit() {
  context_.makeCurrent();
  contents_->timer.submit(frame_);
  endFrame();
  throwIfLost();
  reportErrors();
}

void GlDevice::abandon() {
  if (!recording_) return;
  context_.makeCurrent();
  contents_->timer.drop();
  endFrame();
}

// The driver has received every command of the frame already.
void GlDevice::endFrame() {
  contents_->commands.endFrame();
  fences_[slot()] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
  ++frame_;
  recording_ = false;
}

void GlDevice::wait() {
  context_.makeCurrent();
  glFinish();
  throwIfLost();
  contents_->timer.collect();
}

std::vector<std::byte> GlDevice::read(gpu::Texture texture, uint32_t mip, uint32_t layer) {
  context_.makeCurrent();
  std::vector<std::byte> bytes = readTexture(contents_->resources, texture, mip, layer);
  throwIfLost();
  return bytes;
}

std::vector<std::byte> GlDevice::read(gpu::BufferRange range) {
  context_.makeCurrent();
  std::vector<std::byte> bytes = readBuffer(contents_->resources, range);
  throwIfLost();
  return bytes;
}

bool GlDevice::present(gpu::Texture texture) {
  if (!window_) {
    throw Error(ErrorId::kNoWindow, "OpenGL has no window to show a picture in");
  }
  context_.makeCurrent();
  const bool shown = window_->show(context_, contents_->resources, texture);
  throwIfLost();
  reportErrors();
  return shown;
}

std::vector<gpu::FrameTimes> GlDevice::takeTimes() {
  context_.makeCurrent();
  return contents_->timer.take();
}

void GlDevice::waitForFence(GLsync& fence) {
  constexpr GLuint64 kPatience = 1'000'000'000;  // nanoseconds between two checks for a reset
  if (fence == nullptr) return;
  GLenum status = GL_TIMEOUT_EXPIRED;
  while (status == GL_TIMEOUT_EXPIRED) {
    status = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kPatience);
    throwIfLost();
  }
  glDeleteSync(fence);
  fence = nullptr;
  if (status == GL_WAIT_FAILED) {
    throw Error(ErrorId::kDeviceLost, "OpenGL cannot wait for frame {}", frame_ - kFramesInFlight);
  }
}

void GlDevice::throwIfLost() {
  const GLenum status = glGetGraphicsResetStatus();
  if (status == GL_NO_ERROR) return;
  throw Error(ErrorId::kDeviceLost, "OpenGL reset the device {} (status {:#x})", info_.name,
              status);
}

// Reports errors that debug output did not: each is a bug of this backend, or memory ran out.
void GlDevice::reportErrors() {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) {
    throw Error(ErrorId::kOutOfDeviceMemory, "OpenGL ran out of memory in frame {}", frame_ - 1);
  }
  if (check_) return;
  sink_(gpu::Severity::kError, fmt::format("OpenGL error {:#x} in frame {}", error, frame_ - 1));
}

}  // namespace

std::vector<gpu::ListedDevice> listDevices() {
  std::vector<gpu::ListedDevice> listed;
  for (const Adapter& adapter : adapters()) listed.push_back(adapter.listed);
  return listed;
}

std::unique_ptr<gpu::Device> createDevice(const gpu::DeviceOptions& options) {
  if (options.window != nullptr) return std::make_unique<GlDevice>(options);
  const Adapter& adapter = chooseAdapter(options.device);
  requireVersion(adapter);
  return std::make_unique<GlDevice>(adapter, options);
}

}  // namespace grisaille::opengl
