// SPDX-License-Identifier: MIT
// grisaille scene: prints the contents of a scene, with its animations; writes the scene and a
// camera for it to files.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "app/command.h"
#include "app/options/output_file.h"
#include "app/options/scene_options.h"
#include "app/options/size.h"
#include "core/base/quote.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::app {
namespace {

struct SceneCommand {
  std::string scene, write, writeCamera;
  PoseOptions pose;
};

void showScene(const SceneCommand& options) {
  const NamedOutput outputs[] = {{"--write " + options.write, options.write},
                                 {"--write-camera " + options.writeCamera, options.writeCamera}};
  requireDistinct(outputs);
  scene::Scene scene = scene::loadScene(options.scene);
  const scene::Pose pose = options.pose.poseOf(scene);
  const scene::Camera camera = defaultCamera(scene, pose, aspectOf(kDefaultSize));
  if (pose.animation) scene::pose(scene, pose);
  const scene::Bounds& b = scene.bounds;
  fmt::print(
      "{}: {} triangles, {} primitives, {} instances, {} materials, {} textures\n"
      "bounds {:.3f} {:.3f} {:.3f} to {:.3f} {:.3f} {:.3f} m\n",
      scene.name, scene::triangleCount(scene), scene.primitives.size(), scene.instances.size(),
      scene.materials.size(), scene.textures.size(), b.min.x, b.min.y, b.min.z, b.max.x, b.max.y,
      b.max.z);
  for (size_t i = 0; i < animationsOf(scene).size(); ++i) {
    const scene::Animation& animation = animationsOf(scene)[i];
    fmt::print("animation {}: {}{}{} s\n", i, oneLine(animation.name),
               animation.name.empty() ? "" : ", ", secondsText(animation.duration));
  }
  if (!options.write.empty()) {
    scene::writeGlb(scene, options.write);
    fmt::print("wrote {}\n", options.write);
  }
  if (!options.writeCamera.empty()) {
    scene::saveCamera(camera, options.writeCamera);
    fmt::print("wrote {}\n", options.writeCamera);
  }
}

}  // namespace

void addScene(CLI::App& program) {
  auto options = std::make_shared<SceneCommand>();
  CLI::App* command =
      program.add_subcommand("scene", "Print the contents of a scene; write the scene or a camera");
  command->add_option("scene", options->scene, sceneHelp());
  options->pose.addTo(*command);
  command
      ->add_option("--write", options->write,
                   "Write the scene with its textures, in its pose and without animations")
      ->type_name("FILE.glb");
  command
      ->add_option("--write-camera", options->writeCamera,
                   "Write the default camera of `grisaille render`")
      ->type_name("FILE.json");
  command->callback([options] { showScene(*options); });
}

}  // namespace grisaille::app
