// SPDX-License-Identifier: MIT
// --animation and --time: the pose of a scene.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/rig.h"

namespace grisaille::app {

struct PoseOptions {
  std::string animation;       // name, or number from 0; "": not given
  std::optional<double> time;  // seconds, 0 or more; none: not given

  void addTo(CLI::App& command);
  bool given() const { return !animation.empty() || time; }

  // The pose that the options name: without options the rest pose, without --animation the first
  // animation, without --time its start. Throws kSceneAnimation if the scene has no such animation,
  // or if the time is outside of it.
  scene::Pose poseOf(const scene::Scene& scene) const;
};

// The number of the animation that `text` names: a number from 0, else a name. "": 0. Throws
// kSceneAnimation.
size_t animationOf(const scene::Scene& scene, const std::string& text);

// Throws kSceneAnimation if the animation, which exists, has ended before `seconds`.
void requireWithin(const scene::Scene& scene, size_t animation, double seconds);

// Empty if the scene has no rig.
const std::vector<scene::Animation>& animationsOf(const scene::Scene& scene);

// Its name, or "animation N" if it has none.
std::string labelOf(const scene::Scene& scene, size_t animation);

// A duration with three decimals, rounded down so that it is allowed as --time.
std::string secondsText(double duration);

// The camera of a user who names none: scene::defaultCamera() for a scene at rest; for an animation
// one whose picture holds it at all times. Takes and leaves the scene at rest. The time does not
// matter. aspect: width of the picture divided by its height
scene::Camera defaultCamera(scene::Scene& scene, const scene::Pose& pose, double aspect);

// --animation and --time for this pose; empty for the rest pose.
std::vector<std::string> poseArguments(const scene::Pose& pose);

}  // namespace grisaille::app
