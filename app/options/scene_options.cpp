// SPDX-License-Identifier: MIT
#include "app/options/scene_options.h"

#include <optional>

#include "app/options/camera_option.h"
#include "app/options/size.h"
#include "core/scene/built_in.h"

namespace grisaille::app {

std::string sceneHelp() {
  return "A .gltf or .glb file, or a built-in scene: " + scene::builtInNames() +
         "; default: " + scene::builtIns().front().name;
}

void SceneOptions::addTo(CLI::App& command) {
  command.add_option("scene", scene, sceneHelp());
  command
      .add_option("--camera", camera,
                  "A camera file (JSON with eye, target and fovy_degrees) or its JSON; default: "
                  "a view of the scene")
      ->type_name("FILE|{...}");
  pose.addTo(command);
  command.add_option("--size", size, "Size in pixels; default: the camera's size, else 1280x720")
      ->type_name("WxH");
}

SceneView loadView(const SceneOptions& options) {
  SceneView view;
  std::optional<glm::uvec2> given;
  if (!options.size.empty()) given = parseSize(options.size);
  if (!options.camera.empty()) view.camera = cameraOf(options.camera, "--camera");
  view.scene = scene::loadScene(options.scene);
  view.pose = options.pose.poseOf(view.scene);
  if (given) view.size = *given;
  if (options.camera.empty())
    view.camera = defaultCamera(view.scene, view.pose, aspectOf(view.size));
  if (!given && view.camera.size.x > 0) view.size = view.camera.size;
  return view;
}

}  // namespace grisaille::app
