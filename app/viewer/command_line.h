// SPDX-License-Identifier: MIT
// Writes the `grisaille render` command that makes the viewer's picture, and the arguments that it
// shares with `grisaille tune`.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/effect/selection.h"
#include "core/scene/camera.h"

namespace grisaille::app::viewer {

struct RenderCommand {
  std::string scene = {};              // as of loadScene(); "": the default
  std::vector<std::string> pose = {};  // --animation and --time; empty: at rest
  scene::Camera camera = {};
  std::string path = {}, times = {};        // of a sequence: --path instead of the camera, --times
  glm::uvec2 size = glm::uvec2(1280, 720);  // pixels
  std::string backend = {}, device = {};    // "": no option
  const effect::Selection* effects = nullptr;  // only those switched on; null: none
  std::string surface = "white";
  std::string background = {};  // "": no option
  // --load as effect and file; --write as output and file.
  std::vector<std::pair<std::string, std::string>> loads = {}, writes = {};
  std::vector<std::string> pluginPaths = {};
  std::string video = {};  // of a sequence; "": none
};

// The program's name and its arguments, unquoted. --set names only the parameters that differ from
// their defaults, and the lengths of the scene.
std::vector<std::string> renderArguments(const RenderCommand& command);

// Arguments as one line, quoted for a shell.
std::string quotedLine(const std::vector<std::string>& arguments);
inline std::string renderCommand(const RenderCommand& command) {
  return quotedLine(renderArguments(command));
}

// Appends --effects with the effects that are on, and --set for each of their values that differs
// from its default or is a length of the scene.
void addEffects(const effect::Selection& effects, std::vector<std::string>& arguments);

// The path, with "./" in front if it starts with '-', so that no parser takes it for an option.
std::string plainPath(const std::string& path);

}  // namespace grisaille::app::viewer
