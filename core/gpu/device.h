// SPDX-License-Identifier: MIT
// The interface of the GPU layer: a Device creates resources, its Commands record a frame.
//
// Conventions that hold on every backend: clip space has y up and depth 1 at the near plane, 0 at
// infinity; row 0 of every texture, of gl_FragCoord and of every upload and readback is the top
// row.
//
// Threads: a Device and its Commands belong to one thread at a time. Errors: every function may
// throw grisaille::Error; a call that throws has done nothing. The layer manages barriers, layouts
// and memory: a command sees all writes of the commands recorded before it.
#pragma once

#include <functional>
#include <memory>

#include "core/gpu/types.h"

namespace grisaille::backends {
class Window;  // backends/window.h
}

namespace grisaille::gpu {

// Receives messages of the driver or its validation. Each is one line, without a newline.
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
  bool check = false;        // enable the API's own validation, if it is installed
  bool timed = false;        // time every pass; software drivers then wait after each pass
  MessageSink message = {};  // empty: messages go to standard error
  // Must outlive the device. A device with a window belongs to the main thread.
  backends::Window* window = nullptr;  // null: a device that needs no display
};

class Commands {
 public:
  virtual ~Commands() = default;

  // render() and dispatch() must be called inside a named pass. Timings and debuggers show its
  // label. Passes do not nest. Labels are short: "occlusion", "blur".
  virtual void beginPass(std::string_view label) = 0;
  virtual void endPass() = 0;

  virtual void render(const Render& render) = 0;
  virtual void dispatch(const Dispatch& dispatch) = 0;

  // Copies 1 ... 65536 bytes into memory that later calls of this frame may bind as a uniform
  // buffer.
  virtual BufferRange uniform(std::span<const std::byte> bytes) = 0;

  // Returns a texture that lives until submit(). Its contents are undefined; later frames reuse its
  // memory. Destroying it is an error.
  virtual Texture transient(const TextureDesc& desc) = 0;

  // Copies `bytes` into the resource; rows tightly packed, top row first.
  virtual void upload(Buffer buffer, uint64_t offset, std::span<const std::byte> bytes) = 0;
  virtual void upload(Texture texture, uint32_t mip, uint32_t layer,
                      std::span<const std::byte> bytes) = 0;
};

// Creates and destroys resources: the part of a device that needs no queue.
class Maker {
 public:
  virtual ~Maker() = default;  // destroys the remaining resources

  virtual const DeviceInfo& info() const = 0;

  virtual Buffer createBuffer(const BufferDesc& desc) = 0;
  virtual Texture createTexture(const TextureDesc& desc) = 0;
  virtual Sampler createSampler(const SamplerDesc& desc) = 0;
  virtual ComputePipeline createComputePipeline(const ComputePipelineDesc& desc) = 0;
  virtual GraphicsPipeline createGraphicsPipeline(const GraphicsPipelineDesc& desc) = 0;

  // Allowed at any time: the layer frees the resource once no submitted frame uses it. Destroying
  // the null handle does nothing. Not allowed for transient textures, nor for resources that the
  // frame being recorded already uses.
  virtual void destroy(Buffer buffer) = 0;
  virtual void destroy(Texture texture) = 0;
  virtual void destroy(Sampler sampler) = 0;
  virtual void destroy(ComputePipeline pipeline) = 0;
  virtual void destroy(GraphicsPipeline pipeline) = 0;
};

class Device : public Maker {
 public:
  ~Device() override = default;  // waits for the submitted frames first

  // Begins a frame; waits while too many are in flight. The commands are valid until submit().
  virtual Commands& begin() = 0;
  // Submits the frame. If this throws, the frame is dropped as by abandon().
  virtual void submit() = 0;

  // Drops the frame being recorded, if any. Call it after recording threw.
  virtual void abandon() = 0;

  // Waits for all submitted frames.
  virtual void wait() = 0;

  // Read back one subresource (rows tightly packed, top row first), or a range of a buffer (size 0:
  // to the end of the buffer). Both wait for all submitted frames and are not allowed while
  // recording.
  virtual std::vector<std::byte> read(Texture texture, uint32_t mip = 0, uint32_t layer = 0) = 0;
  virtual std::vector<std::byte> read(BufferRange range) = 0;

  // Copies the first level and layer of a kRgba8Unorm texture, texel for pixel, to the top left
  // corner of the window, fills the remaining area with black, and shows the window's new contents.
  // Not allowed while recording. Returns false if nothing was shown: the window has no area or is
  // iconified, or its surface has changed. The caller then draws again at the window's new size.
  // Waits for a display that is slower than the caller, but never for ever.
  virtual bool present(Texture texture) = 0;

  // Returns the timed frames that finished since the last call, oldest first; empty unless
  // DeviceOptions::timed is set. On hardware a frame appears a few frames after its submit(), or
  // after wait().
  virtual std::vector<FrameTimes> takeTimes() = 0;
};

}  // namespace grisaille::gpu
