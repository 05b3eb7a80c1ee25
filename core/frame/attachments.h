// SPDX-License-Identifier: MIT
// The source of a frame's attachments: a scene that is drawn, or pictures of another renderer.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

#include "core/gpu/device.h"
#include "core/scene/view.h"

namespace grisaille::frame {

// The motion of surfaces since the previous frame; see GRISAILLE_MOTION.
struct MotionTarget {
  gpu::Texture texture;  // kRgba16Float; null: not wanted
  // The previous frame's view, in this frame's size and widened to its guard band. Nothing: the
  // motion is unknown.
  std::optional<scene::View> then;
  glm::dvec2 guard = {};  // pixels on each side
};

// The attachments that a source fills; all but depth may be null.
struct AttachmentTargets {
  gpu::Texture depth;        // kD32Float: clip depth
  gpu::Texture viewDepth;    // kR32Float
  gpu::Texture normal;       // kRgba16Float
  gpu::Texture baseColour;   // kRgba8Srgb
  gpu::Texture facetNormal;  // kRgba16Float
  gpu::Texture backDepth;    // kR32Float
  gpu::Texture nextDepth;    // kR32Float
  gpu::Texture thickness;    // kR32Float; only with a normal
  MotionTarget motion;
};

class AttachmentSource {
 public:
  virtual ~AttachmentSource() = default;

  // Whether the source can fill guard bands beyond the picture.
  virtual bool goesBeyond() const = 0;

  // Whether the source can fill the motion of surfaces.
  virtual bool hasMotion() const { return false; }
  // Whether the source can fill the thickness of matter.
  virtual bool hasThickness() const { return false; }
  // Counts the changes of what the source shows, apart from the camera.
  virtual uint64_t poses() const { return 0; }
  // Ends a frame. `motion`: whether the next frame's motion is since this frame.
  virtual void finish(bool motion) { (void)motion; }
  // Whether motion since the previous frame is known, which was drawn in pose number `poses`.
  virtual bool knowsMotion(uint64_t poses) const { return poses == this->poses(); }

  // Fills every pixel of each target; all have the view's size. Call it outside a pass; the labels
  // of its passes begin with `passes`. Throws kPictureMissing for an attachment that this source
  // lacks.
  virtual void record(gpu::Commands& commands, const scene::View& view, gpu::BufferRange viewBlock,
                      const AttachmentTargets& targets, std::string_view passes) = 0;
};

}  // namespace grisaille::frame
