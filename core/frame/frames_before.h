// SPDX-License-Identifier: MIT
// The frames that a renderer drew before, for the motion of the next one.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>

#include "core/effect/chain.h"
#include "core/frame/attachments.h"
#include "core/scene/camera.h"

namespace grisaille::frame {

// An effect of a chain that reads motion.
using MotionReader = std::pair<const effect::Chain*, const effect::Effect*>;

class FramesBefore {
 public:
  // The camera of the previous frame; nothing if motion since then is not known to all readers.
  // Motion is since the previous frame, whoever reads it. An effect that did not run in that frame
  // would take it for the motion since its own last frame: unless nothing moved since then, the
  // motion is unknown.
  std::optional<scene::Camera> cameraFor(std::span<const MotionReader> readers,
                                         const AttachmentSource& source) const;

  // Counts a frame that was drawn.
  void add(const scene::Camera& camera, std::span<const MotionReader> readers,
           const AttachmentSource& source);

 private:
  struct Drawn {
    uint64_t frame = 0;  // its number
    uint64_t poses = 0;  // of the source
    scene::Camera camera;
  };
  uint64_t frames_ = 0;
  std::optional<Drawn> last_;
  std::map<MotionReader, Drawn> ofReaders_;  // the last frame of each reader
};

}  // namespace grisaille::frame
