// SPDX-License-Identifier: MIT
// A device that belongs to a host program. The program begins frames, submits and waits. The layer
// creates resources on the device and records its commands among those of the program.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::gpu {

// A texture of the program, as a native object of its API: one level, one sample.
struct ForeignTexture {
  uint64_t name = 0;    // a VkImage, or an OpenGL texture's name
  uint32_t format = 0;  // a VkFormat; OpenGL: not used
  uint32_t layout = 0;  // a VkImageLayout, before and after every recording; OpenGL: not used
  uint32_t width = 0;   // pixels; OpenGL: 0 takes the size of the texture
  uint32_t height = 0;
  uint32_t firstLayer = 0;  // of an array
  uint32_t layers = 1;      // from firstLayer on
};

// Properties of a wrapped foreign texture. Layer 0 is the program's firstLayer.
struct ForeignInfo {
  uint32_t width = 0;  // pixels
  uint32_t height = 0;
  uint32_t layers = 1;
  uint32_t channels = 0;  // 1 ... 4 colour channels
  bool depth = false;
  std::string format = {};  // for messages: "VK_FORMAT_D32_SFLOAT (126)"
};

// Memory that a device holds.
struct MemoryUse {
  uint64_t deviceBytes = 0;  // of textures and buffers that the GPU alone uses
  uint64_t hostBytes = 0;    // of buffers that the CPU writes and the GPU reads
  uint32_t allocations = 0;
};

// A texture of the layer, as a native object of the program's API.
struct NativeTexture {
  uint64_t name = 0;    // a VkImage, or an OpenGL texture's name
  uint64_t view = 0;    // a VkImageView of the whole texture; OpenGL: 0
  uint32_t format = 0;  // a VkFormat, or an OpenGL internal format
  uint32_t layout = 0;  // a VkImageLayout, after a recording; OpenGL: 0
};

class HostDevice : public Maker {
 public:
  // Returns a handle for a texture of the program. Shaders may only read it. Destroying the handle
  // does not destroy the program's texture. Throws kHostTexture if shaders cannot read the texture.
  virtual Texture wrap(const ForeignTexture& texture) = 0;
  virtual ForeignInfo foreign(Texture texture) = 0;

  // Begins a recording into the program's command buffer (OpenGL: null). `frame` is the program's
  // frame number and never decreases: on Vulkan, the recordings of frame n have finished when frame
  // n + frames_in_flight begins. `reads` are the foreign textures that this recording reads.
  // `label` names the recording in debuggers. Throws kHostFrame.
  virtual Commands& begin(void* commandBuffer, uint64_t frame, std::span<const Texture> reads,
                          std::string_view label) = 0;

  // Ends the recording: all later commands of the program see its writes, and may read the textures
  // `writes`. Call it also after a recording that threw.
  virtual void end(std::span<const Texture> writes) = 0;

  // Makes the contents of a texture undefined, as of a new one: for a recording that the program
  // dropped instead of submitting it.
  virtual void forget(Texture texture) = 0;

  // The memory that the device's resources take now.
  virtual MemoryUse memory() const = 0;
  // Bytes of device memory that a resource would take.
  virtual uint64_t bytesOf(const TextureDesc& desc) const = 0;
  virtual uint64_t bytesOf(const BufferDesc& desc) const = 0;

  virtual NativeTexture native(Texture texture) = 0;

  // Throws kHostContext if the program's state forbids using the device: on OpenGL, if the device's
  // context is not current.
  virtual void requireUsable() const = 0;
};

}  // namespace grisaille::gpu
