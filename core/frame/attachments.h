// SPDX-License-Identifier: MIT
// Where the attachments of a frame come from: a scene that is drawn, or pictures made elsewhere.
#pragma once

#include <string_view>

#include "core/gpu/device.h"
#include "core/scene/camera.h"

namespace grisaille::frame {

// What a frame is to be given; all but depth may be null.
struct AttachmentTargets {
  gpu::Texture depth;        // kD32Float: clip depth
  gpu::Texture viewDepth;    // kR32Float
  gpu::Texture normal;       // kRgba16Float
  gpu::Texture baseColour;   // kRgba8Srgb
  gpu::Texture facetNormal;  // kRgba16Float
  gpu::Texture backDepth;    // kR32Float
};

class AttachmentSource {
 public:
  virtual ~AttachmentSource() = default;

  // Whether it has more to show than a camera's picture: guard bands.
  virtual bool goesBeyond() const = 0;

  // Fills the whole of each target, which are of this size. Not inside a pass; the labels of its
  // own begin with `passes`. Throws kPictureMissing for what this source does not have.
  virtual void record(gpu::Commands& commands, const scene::Camera& camera, uint32_t width,
                      uint32_t height, gpu::BufferRange viewBlock, const AttachmentTargets& targets,
                      std::string_view passes) = 0;
};

}  // namespace grisaille::frame
