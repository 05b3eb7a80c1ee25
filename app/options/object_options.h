// SPDX-License-Identifier: MIT
// The options --load, --add and --save, which fill and save the objects of a chain's effects.
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

  // Checks the options without loading a file. Throws kUsage, kEffectUnknown if an effect is not
  // active, kEffectTakesNoObjects, kObjectFileEnding.
  void check(effect::Chain& chain) const;

  // Adds the objects of --load. Throws kObject*.
  void load(effect::Chain& chain) const;

  // Calls load(), then adds the objects of --add. `camera` and `size` (pixels) place an object that
  // names a pixel; `rays` find the surface there. Throws kObject*, kUsage.
  void apply(effect::Chain& chain, const scene::Camera& camera, glm::uvec2 size,
             effect::RayService& rays) const;

  // Writes the files of --save. Throws as objects::save() does.
  void save(effect::Chain& chain) const;

  // The files of --save, named for messages.
  std::vector<NamedOutput> outputs() const;
};

}  // namespace grisaille::app
