// SPDX-License-Identifier: MIT
// The session's time: the pose of the scene, and how it plays.
#include <algorithm>
#include <cmath>

#include "app/viewer/session.h"

namespace grisaille::app::viewer {

double Session::duration() const {
  const std::vector<scene::Animation>& all = animationsOf(*scene);
  const size_t index = playback.pose.animation.value_or(0);
  return index < all.size() ? all[index].duration : 0;
}

void Session::takePose(const scene::Pose& pose) {
  if (playback.pose == pose) return;
  services->rays().wait();  // they read the scene
  try {
    scene::pose(*posed_, pose);
    playback.pose = pose;
  } catch (const Error&) {
    // A scene after a failed pose is not usable.
    playback = {};
    scene::pose(*posed_, {});
    throw;
  }
}

void Session::seek(double seconds) {
  if (!hasAnimations()) return;
  if (!playback.pose.animation) choose(0);
  takePose({.animation = playback.pose.animation, .seconds = std::clamp(seconds, 0.0, duration())});
}

void Session::choose(std::optional<size_t> animation) {
  if (playback.pose.animation == animation) return;
  const bool home = camera.eye == homeCamera.eye && camera.target == homeCamera.target;
  takePose({});
  services->rays().wait();
  if (!homeGiven_) homeCamera = defaultCamera(*posed_, {.animation = animation}, aspect_);
  if (home) camera = homeCamera;
  takePose({.animation = animation, .seconds = 0});
}

void Session::play(bool on) {
  if (!hasAnimations()) return;
  if (on && !playback.pose.animation) choose(0);
  playback.playing = on;
}

void Session::advance(double seconds) {
  if (paused) return;
  advancePreview(seconds);
  if (!playback.playing) return;
  const double length = duration();
  const double next = playback.pose.seconds + seconds * playback.speed;
  attempt("pose", [&] { seek(length > 0 ? std::fmod(next, length) : 0); });
}

// Beyond either end, the time goes on at the other.
void Session::stepFrames(int frames) {
  if (!hasAnimations()) return;
  play(false);
  const double next = frameNumber() + frames;
  const double frame = next < 0 ? lastFrame() : next > lastFrame() ? 0 : next;
  attempt("pose", [&] { seek(frame / Playback::kFrames); });
}

double Session::frameNumber() const {
  return std::floor(playback.pose.seconds * Playback::kFrames + kWithin);
}

double Session::lastFrame() const {
  return std::floor(duration() * Playback::kFrames + kWithin);
}

}  // namespace grisaille::app::viewer
