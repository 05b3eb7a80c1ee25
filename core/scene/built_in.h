// SPDX-License-Identifier: MIT
// The scenes that the program builds itself. Each has a name, which loadScene() takes in place of a
// file.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace grisaille::scene {

struct BuiltIn {
  const char* name;   // one lower-case word
  const char* about;  // what it shows, one line
  Scene (*make)();    // Scene::camera is set; every machine builds the scene bit for bit the same
  double radius;      // of ambient occlusion that suits it, metres
};

// All of them; the first is the atrium, the default.
std::span<const BuiltIn> builtIns();

// The one with this name, or null. "" names the atrium.
const BuiltIn* findBuiltIn(std::string_view name);

// Their names, for messages and help: "atrium, leaves, ..."
std::string builtInNames();

}  // namespace grisaille::scene
