// SPDX-License-Identifier: MIT
// Textures that live for one frame, handed out again in later frames.
#pragma once

#include <functional>
#include <vector>

#include "core/gpu/types.h"

namespace grisaille::gpu {

class TransientPool {
 public:
  using Create = std::function<Texture(const TextureDesc&)>;
  using Destroy = std::function<void(Texture)>;

  // A texture like `desc` that this frame has not handed out yet; makes one where there is none.
  Texture take(const TextureDesc& desc, const Create& create);

  // The frame's end: all may be handed out again. Destroys those that `kIdleFrames` frames did not
  // use.
  void endFrame(const Destroy& destroy);

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
