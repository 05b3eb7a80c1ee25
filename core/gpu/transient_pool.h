// SPDX-License-Identifier: MIT
// A pool of textures that live for one frame; later frames reuse them.
#pragma once

#include <functional>
#include <vector>

#include "core/gpu/types.h"

namespace grisaille::gpu {

class TransientPool {
 public:
  using Create = std::function<Texture(const TextureDesc&)>;
  using Destroy = std::function<void(Texture)>;

  // Returns a texture that matches `desc` and that this frame has not taken yet. Creates one if the
  // pool has none.
  Texture take(const TextureDesc& desc, const Create& create);

  // Ends the frame: all textures may be taken again. Destroys textures that were not taken for more
  // than `kIdleFrames` frames.
  void endFrame(const Destroy& destroy);

  // Destroys all textures, also those that this frame has taken.
  void clear(const Destroy& destroy);

 private:
  static constexpr uint32_t kIdleFrames = 3;
  struct Entry {
    TextureDesc desc;  // its label is not kept
    Texture texture;
    uint32_t idle = 0;
    bool taken = false;
  };
  std::vector<Entry> entries_;
};

}  // namespace grisaille::gpu
