// SPDX-License-Identifier: MIT
// A device that belongs to a host program. The program begins frames, submits and waits. The layer
// creates resources on the device and records its commands among those of the program.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::gpu {

// A texture of the program, as a native object of its API: one level, one layer, one sample.
struct ForeignTexture {
  uint64_t name = 0;    // a VkImage, or an OpenGL texture's name
  uint32_t format = 0;  // a VkFormat; OpenGL: not used
  uint32_t layout = 0;  // a VkImageLayout, before and after every recording; OpenGL: not used
  uint32_t width = 0;   // pixels; OpenGL: 0 takes the size of the texture
  uint32_t height = 0;
};

// Properties of a wrapped foreign texture.
struct ForeignInfo {
  uint32_t width = 0;  // pixels
  uint32_t height = 0;
  uint32_t channels = 0;  // 1 ... 4 colour channels
  bool depth = false;
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
  // n + frames_in_flight begins. `reads` are the foreign textures that this recording reads. Throws
  // kHostFrame.
  virtual Commands& begin(void* commandBuffer, uint64_t frame, std::span<const Texture> reads) = 0;

  // Ends the recording: all later commands of the program see its writes, and may read the textures
  // `writes`. Call it also after a recording that threw.
  virtual void end(std::span<const Texture> writes) = 0;

  // Makes the contents of a texture undefined, as of a new one: for a recording that the program
  // dropped instead of submitting it. forgetTransients() does so for all transient textures.
  virtual void forget(Texture texture) = 0;
  virtual void forgetTransients() = 0;

  virtual NativeTexture native(Texture texture) = 0;

  // Throws kHostContext if the program's state forbids using the device: on OpenGL, if the device's
  // context is not current.
  virtual void requireUsable() const = 0;
};

}  // namespace grisaille::gpu
