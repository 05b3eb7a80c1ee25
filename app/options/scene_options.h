// SPDX-License-Identifier: MIT
// The scene, camera and size of commands that draw or trace one view.
#pragma once

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <string>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::app {

constexpr glm::uvec2 kDefaultSize = glm::uvec2(1280, 720);  // of a picture, pixels

struct SceneOptions {
  std::string scene, camera, size;  // empty: not given

  void addTo(CLI::App& command);
};

struct SceneView {
  scene::Scene scene;
  scene::Camera camera;
  glm::uvec2 size = kDefaultSize;  // pixels
};

// The view that the options name. Checks size and camera before it loads the scene. Throws as
// parseSize(), cameraOf() and scene::loadScene() do.
SceneView loadView(const SceneOptions& options);

}  // namespace grisaille::app
