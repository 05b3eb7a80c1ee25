// SPDX-License-Identifier: MIT
// Undo for the camera, apart from that of settings and objects: where the user has been.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/scene/camera.h"

namespace grisaille::app::viewer {

class CameraHistory {
 public:
  static constexpr size_t kMost = 1000;  // places kept; then the oldest go

  // Forgets all places but this one.
  void begin(const scene::Camera& now);

  // Adds the camera's place, unless it is the last one. Call whenever the camera rests. Forgets the
  // places that forward() would return.
  void note(const scene::Camera& now);

  // The place before or after `now`; none at either end. back() notes `now` first.
  std::optional<scene::Camera> back(const scene::Camera& now);
  std::optional<scene::Camera> forward(const scene::Camera& now);

 private:
  bool isHere(const scene::Camera& camera) const;

  std::vector<scene::Camera> places_;
  size_t here_ = 0;  // index of the last place noted or returned
};

}  // namespace grisaille::app::viewer
