// SPDX-License-Identifier: MIT
// The `grisaille render` command that makes the viewer's picture, and what other commands share
// with it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/effect/selection.h"
#include "core/scene/camera.h"

namespace grisaille::app::viewer {

struct RenderCommand {
  std::string scene = {};  // a file; "": the built-in scene
  scene::Camera camera = {};
  glm::uvec2 size = glm::uvec2(1280, 720);     // pixels
  std::string backend = {}, device = {};       // "": left out
  const effect::Selection* effects = nullptr;  // those that are on; null: none
  std::string surface = "white";
  // Effect and file, output and file.
  std::vector<std::pair<std::string, std::string>> loads = {}, writes = {};
  std::vector<std::string> pluginPaths = {};
};

// The program's name and its arguments, unquoted. Only values that differ from their defaults.
std::vector<std::string> renderArguments(const RenderCommand& command);

// The same as one line for a shell.
std::string renderCommand(const RenderCommand& command);

// --effects with those that are on, and --set for their values that differ from the defaults, but
// for those of the parameters that are left out.
void addEffects(const effect::Selection& effects, const std::vector<effect::ParameterName>& leftOut,
                std::vector<std::string>& arguments);

// A path that no command line takes for an option.
std::string plainPath(const std::string& path);

}  // namespace grisaille::app::viewer
