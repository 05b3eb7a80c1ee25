// SPDX-License-Identifier: MIT
// The scene, camera and size of commands that draw or trace one view.
#pragma once

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <string>

#include "app/options/pose_options.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::app {

constexpr glm::uvec2 kDefaultSize = glm::uvec2(1280, 720);  // of a picture, pixels

// The help of an argument that names a scene.
std::string sceneHelp();

struct SceneOptions {
  std::string scene, camera, size;  // empty: not given
  PoseOptions pose;

  void addTo(CLI::App& command);
};

// The scene is at rest until takePose(), so that lengths that are chosen for it are the same at all
// times.
struct SceneView {
  scene::Scene scene;
  scene::Pose pose;
  scene::Camera camera;
  glm::uvec2 size = kDefaultSize;  // pixels

  // Throws as scene::pose() does.
  void takePose() {
    if (pose.animation) scene::pose(scene, pose);
  }
};

// The view that the options name. Checks size and camera before it loads the scene. Throws as
// parseSize(), cameraOf(), scene::loadScene() and PoseOptions::poseOf() do.
SceneView loadView(const SceneOptions& options);

}  // namespace grisaille::app
