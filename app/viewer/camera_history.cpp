// SPDX-License-Identifier: MIT
#include "app/viewer/camera_history.h"

namespace grisaille::app::viewer {

void CameraHistory::begin(const scene::Camera& now) {
  places_ = {now};
  here_ = 0;
}

bool CameraHistory::isHere(const scene::Camera& camera) const {
  if (places_.empty()) return false;
  const scene::Camera& place = places_[here_];
  return place.eye == camera.eye && place.target == camera.target && place.up == camera.up &&
         place.fovyDegrees == camera.fovyDegrees &&
         place.orthographicHeight == camera.orthographicHeight && place.shift == camera.shift;
}

void CameraHistory::note(const scene::Camera& now) {
  if (isHere(now)) return;
  if (!places_.empty()) places_.resize(here_ + 1);
  places_.push_back(now);
  if (places_.size() > kMost) places_.erase(places_.begin());
  here_ = places_.size() - 1;
}

std::optional<scene::Camera> CameraHistory::back(const scene::Camera& now) {
  note(now);
  if (here_ == 0) return std::nullopt;
  return places_[--here_];
}

std::optional<scene::Camera> CameraHistory::forward(const scene::Camera& now) {
  note(now);
  if (here_ + 1 >= places_.size()) return std::nullopt;
  return places_[++here_];
}

}  // namespace grisaille::app::viewer
