// SPDX-License-Identifier: MIT
// The objects of a command: what --load, --add and --save say of the lists of a chain's effects.
#pragma once

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "app/options/output_file.h"
#include "core/effect/chain.h"
#include "core/scene/camera.h"

namespace grisaille::app {

struct ObjectOptions {
  std::vector<std::string> loads, adds, saves;

  void addTo(CLI::App& command);

  // Throws kUsage, kEffectUnknown where an effect is not active, kEffectTakesNoObjects,
  // kObjectFileEnding: what can be told before anything is loaded.
  void check(effect::Chain& chain) const;

  // Throws kObject*.
  void load(effect::Chain& chain) const;

  // Loads, then adds as seen from the camera in a picture of this size. Throws kObject*, kUsage.
  void apply(effect::Chain& chain, const scene::Camera& camera, glm::uvec2 size,
             effect::RayService& rays) const;

  // What --save asks for. Throws as objects::save() does.
  void save(effect::Chain& chain) const;

  // The files of --save, with their words.
  std::vector<NamedOutput> outputs() const;
};

}  // namespace grisaille::app
