// SPDX-License-Identifier: MIT
// The shots of a command: what --load, --fire and --save say, one list an effect that takes shots.
#pragma once

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "app/settings/active_effects.h"
#include "core/scene/camera.h"
#include "core/shots/shot_list.h"

namespace grisaille::app {

struct ShotOptions {
  std::vector<std::string> loads, fires, saves;
  std::string coverage;

  void addTo(CLI::App& command);
};

// By effect.
class Shots {
 public:
  // Loads, then fires from the camera. Throws kShot*, kUsage, kEffectUnknown where an effect is not
  // active, kEffectTakesNoShots.
  Shots(const ShotOptions& options, ActiveEffects& active, const scene::Camera& camera,
        glm::uvec2 size);

  std::span<const grisaille_shot> of(std::string_view effect) const;

  // What --save asks for. Throws as shots::save() does.
  void save() const;

 private:
  struct File {
    std::string effect, path;
  };
  static File parseFile(const std::string& text, ActiveEffects& active);

  std::map<std::string, shots::ShotList, std::less<>> lists_;
  std::vector<File> saves_;
};

}  // namespace grisaille::app
