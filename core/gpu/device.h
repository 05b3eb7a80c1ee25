// SPDX-License-Identifier: MIT
// The layer's interface: a Device makes resources, its Commands record a frame.
//
// Conventions that hold on every backend: clip space has y up and depth 1 at the near plane, 0 at
// infinity; row 0 of every texture, of gl_FragCoord and of every upload and readback is the top
// row.
//
// Threads: a Device and its Commands belong to one thread at a time. Errors: every function may
// throw grisaille::Error; a call that throws has done nothing. Barriers, layouts and memory are the
// layer's business: work recorded later sees what work recorded before it wrote.
#pragma once

#include <functional>
#include <memory>

#include "core/gpu/types.h"

namespace grisaille::backends {
class Window;  // backends/window.h
}

namespace grisaille::gpu {

// A message of a driver or its validation. One line, without a newline.
enum class Severity : uint8_t { kInfo, kWarning, kError };
using MessageSink = std::function<void(Severity, std::string_view)>;

// One entry of a backend's list of devices.
struct ListedDevice {
  std::string name;
  std::string driver;
  bool software = false;
};

struct DeviceOptions {
  std::string device = {};   // "", a number or part of a name, as listed by the backend
  bool check = false;        // the API's own validation, where it is installed
  bool timed = false;        // time every pass; on software drivers this waits for each
  MessageSink message = {};  // none: standard error
  // Outlives the device, which then belongs to the main thread.
  backends::Window* window = nullptr;  // null: a device that needs no display
};

class Commands {
 public:
  virtual ~Commands() = default;

  // Work is recorded inside named passes, which are timed and labelled for debuggers. Passes do not
  // nest. Labels are short: "occlusion", "blur".
  virtual void beginPass(std::string_view label) = 0;
  virtual void endPass() = 0;

  virtual void render(const Render& render) = 0;
  virtual void dispatch(const Dispatch& dispatch) = 0;

  // Copies 1 ... 65536 bytes for use as a uniform buffer by this frame's later calls.
  virtual BufferRange uniform(std::span<const std::byte> bytes) = 0;

  // A texture that lives until submit(). Contents are undefined; memory is reused from frame to
  // frame. Destroying it is an error.
  virtual Texture transient(const TextureDesc& desc) = 0;

  // Copies `bytes` into the resource; rows tightly packed, top row first.
  virtual void upload(Buffer buffer, uint64_t offset, std::span<const std::byte> bytes) = 0;
  virtual void upload(Texture texture, uint32_t mip, uint32_t layer,
                      std::span<const std::byte> bytes) = 0;
};

// Makes what handles name and destroys it: the part of a device that needs no queue.
class Maker {
 public:
  virtual ~Maker() = default;  // destroys what is left

  virtual const DeviceInfo& info() const = 0;

  virtual Buffer createBuffer(const BufferDesc& desc) = 0;
  virtual Texture createTexture(const TextureDesc& desc) = 0;
  virtual Sampler createSampler(const SamplerDesc& desc) = 0;
  virtual ComputePipeline createComputePipeline(const ComputePipelineDesc& desc) = 0;
  virtual GraphicsPipeline createGraphicsPipeline(const GraphicsPipelineDesc& desc) = 0;

  // Allowed at any time: the resource goes once no submitted frame uses it. Destroying the null
  // handle does nothing. Not allowed for transient textures and for what the frame being recorded
  // uses already.
  virtual void destroy(Buffer buffer) = 0;
  virtual void destroy(Texture texture) = 0;
  virtual void destroy(Sampler sampler) = 0;
  virtual void destroy(ComputePipeline pipeline) = 0;
  virtual void destroy(GraphicsPipeline pipeline) = 0;
};

class Device : public Maker {
 public:
  ~Device() override = default;  // waits for the device first

  // Begins a frame; waits while too many are in flight. The commands are valid until submit().
  virtual Commands& begin() = 0;
  // Where the device fails it, the frame is dropped as by abandon().
  virtual void submit() = 0;

  // Drops the frame being recorded, if there is one: for callers whose recording threw.
  virtual void abandon() = 0;

  // Waits for everything submitted.
  virtual void wait() = 0;

  // One subresource, rows tightly packed, top row first; a range of a buffer (size 0: to its end).
  // Both wait for everything submitted and are not allowed while recording.
  virtual std::vector<std::byte> read(Texture texture, uint32_t mip = 0, uint32_t layer = 0) = 0;
  virtual std::vector<std::byte> read(BufferRange range) = 0;

  // Copies a kRgba8Unorm texture's first level and layer, texel for pixel, to the window's top left
  // corner, and shows it; the rest is black. Not while recording. False: nothing was shown, since
  // the window has no area or is iconified, or its surface has changed under it: the caller draws
  // again at the window's new size. Waits for the display where it shows pictures slower than they
  // come, but never for ever.
  virtual bool present(Texture texture) = 0;

  // The frames timed and finished since the last call, oldest first; empty unless
  // DeviceOptions::timed. On hardware a frame appears a few frames after its submit(), or after
  // wait().
  virtual std::vector<FrameTimes> takeTimes() = 0;
};

}  // namespace grisaille::gpu
