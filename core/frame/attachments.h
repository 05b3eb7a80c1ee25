// SPDX-License-Identifier: MIT
// The source of a frame's attachments: a scene that is drawn, or pictures of another renderer.
#pragma once

#include <string_view>

#include "core/gpu/device.h"
#include "core/scene/camera.h"

namespace grisaille::frame {

// The attachments that a source fills; all but depth may be null.
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

  // Whether the source can fill guard bands beyond the picture.
  virtual bool goesBeyond() const = 0;

  // Fills every pixel of each target; all have this size. Call it outside a pass; the labels of its
  // passes begin with `passes`. Throws kPictureMissing for an attachment that this source lacks.
  virtual void record(gpu::Commands& commands, const scene::Camera& camera, uint32_t width,
                      uint32_t height, gpu::BufferRange viewBlock, const AttachmentTargets& targets,
                      std::string_view passes) = 0;
};

}  // namespace grisaille::frame
