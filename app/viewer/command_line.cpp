// SPDX-License-Identifier: MIT
#include "app/viewer/command_line.h"

#include <fmt/format.h>

#include "core/base/quote.h"

namespace grisaille::app::viewer {

std::string plainPath(const std::string& path) {
  return path.starts_with('-') ? "./" + path : path;
}

void addEffects(const effect::Selection& effects, std::vector<std::string>& arguments) {
  std::string keys;
  std::vector<std::string> sets;
  for (const effect::Selection::Entry& entry : effects.entries()) {
    if (!entry.on) continue;
    keys += (keys.empty() ? "" : ",") + std::string(entry.key());
    const effect::Values defaults(entry.effect());
    for (const grisaille_param_desc& param : entry.effect().params()) {
      const std::string text = entry.values.text(param.key);
      const bool ofScene = (param.flags & GRISAILLE_PARAM_SCENE_LENGTH) != 0;
      if (text == defaults.text(param.key) && !ofScene) continue;
      const effect::Assignment set{.name = {.effect = entry.key(), .key = param.key},
                                   .value = text};
      sets.push_back(set.text());
    }
  }
  arguments.insert(arguments.end(), {"--effects", keys});
  for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
}

std::vector<std::string> renderArguments(const RenderCommand& command) {
  std::vector<std::string> arguments = {"grisaille", "render"};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.insert(arguments.end(), {option, value});
  };
  // Before --effects, which would take the path as another effect.
  if (!command.scene.empty()) arguments.push_back(plainPath(command.scene));
  arguments.insert(arguments.end(), command.pose.begin(), command.pose.end());
  scene::Camera camera = command.camera;
  camera.size = glm::uvec2(0);  // --size gives it
  if (command.path.empty()) {
    add("--camera", scene::cameraJson(camera));
  } else {
    add("--path", command.path);
  }
  if (!command.times.empty()) add("--times", command.times);
  add("--size", fmt::format("{}x{}", command.size.x, command.size.y));
  if (!command.backend.empty()) add("--backend", command.backend);
  if (!command.device.empty()) add("--device", command.device);
  for (const std::string& path : command.pluginPaths) add("--plugin-path", plainPath(path));
  if (command.effects != nullptr) {
    addEffects(*command.effects, arguments);
  } else {
    add("--effects", "");
  }
  add("--surface", command.surface);
  if (!command.background.empty()) add("--background", command.background);
  for (const auto& [effect, file] : command.loads) add("--load", effect + "=" + file);
  for (const auto& [output, file] : command.writes) add("--write", output + "=" + file);
  if (!command.video.empty()) add("--video", command.video);
  return arguments;
}

std::string quotedLine(const std::vector<std::string>& arguments) {
  std::string line;
  for (const std::string& argument : arguments) {
    line += (line.empty() ? "" : " ") + shellQuoted(argument);
  }
  return line;
}

}  // namespace grisaille::app::viewer
