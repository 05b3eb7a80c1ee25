// SPDX-License-Identifier: MIT
#include "core/frame/frames_before.h"

namespace grisaille::frame {

std::optional<scene::Camera> FramesBefore::cameraFor(std::span<const MotionReader> readers,
                                                     const AttachmentSource& source) const {
  if (!last_ || !source.knowsMotion(last_->poses)) return std::nullopt;
  for (const MotionReader& reader : readers) {
    const auto seen = ofReaders_.find(reader);
    if (seen == ofReaders_.end()) continue;  // it has no earlier frame
    const Drawn& its = seen->second;
    if (its.frame != last_->frame && its.poses != source.poses()) return std::nullopt;
  }
  return last_->camera;
}

void FramesBefore::add(const scene::Camera& camera, std::span<const MotionReader> readers,
                       const AttachmentSource& source) {
  last_ = {.frame = ++frames_, .poses = source.poses(), .camera = camera};
  for (const MotionReader& reader : readers) ofReaders_.insert_or_assign(reader, *last_);
}

}  // namespace grisaille::frame
