// SPDX-License-Identifier: MIT
// A device that belongs to another program, which begins, submits and waits: the layer makes
// resources on it and records into what the program records itself.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::gpu {

// A texture of that program, as its API names it: one level, one layer, one sample.
struct ForeignTexture {
  uint64_t name = 0;    // a VkImage, or an OpenGL texture's name
  uint32_t format = 0;  // a VkFormat; OpenGL: not used
  uint32_t layout = 0;  // a VkImageLayout, before and after every recording; OpenGL: not used
  uint32_t width = 0;   // pixels; OpenGL: 0: as the texture has them
  uint32_t height = 0;
};

// What a foreign texture turned out to be.
struct ForeignInfo {
  uint32_t width = 0;  // pixels
  uint32_t height = 0;
  uint32_t channels = 0;  // 1 ... 4 of a colour
  bool depth = false;
};

// One of the layer's textures, as that program's API names it.
struct NativeTexture {
  uint64_t name = 0;    // a VkImage, or an OpenGL texture's name
  uint64_t view = 0;    // a VkImageView of all of it; OpenGL: 0
  uint32_t format = 0;  // a VkFormat, or an OpenGL internal format
  uint32_t layout = 0;  // a VkImageLayout, after a recording; OpenGL: 0
};

class HostDevice : public Maker {
 public:
  // Destroyed as other textures are, but for what the program owns. Reads alone are allowed, by
  // shaders. Throws kHostTexture for what cannot be read so.
  virtual Texture wrap(const ForeignTexture& texture) = 0;
  virtual ForeignInfo foreign(Texture texture) = 0;

  // Begins to record into the program's command buffer (Vulkan; else null), which has a `frame`
  // that never falls: recordings of frames that are so many behind as the device was told have
  // finished. `reads` are the foreign textures that what follows reads. Throws kHostFrame.
  virtual Commands& begin(void* commandBuffer, uint64_t frame, std::span<const Texture> reads) = 0;

  // Ends it: what it did is visible to all that the program does later. `writes` can be read then.
  // Also after a recording that threw.
  virtual void end(std::span<const Texture> writes) = 0;

  virtual NativeTexture native(Texture texture) = 0;

  // Throws kHostContext unless the program's state lets the device be used: OpenGL's context.
  virtual void requireUsable() const = 0;
};

}  // namespace grisaille::gpu
