// SPDX-License-Identifier: MIT
// The options that `render` and `apply` share: effects, their values, device and output files.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/settings/load_effects.h"
#include "app/settings/settings.h"
#include "core/effect/chain.h"
#include "core/frame/renderer.h"

namespace grisaille::app {

struct EffectOptions {
  std::vector<std::string> effects, presets, sets, writes, pluginPaths;
  std::string surface = "white", background, backend, device, config;
  bool check = false;
  // The options, to tell whether the command line has them; null before addTo().
  const CLI::Option *effectsGiven = nullptr, *surfaceGiven = nullptr, *backgroundGiven = nullptr;

  // Adds the options to `command`, which keeps references to this. Returns --write, with `help` as
  // its help text.
  CLI::Option* addTo(CLI::App& command, const std::string& help);
};

// The chain of effects that the options describe.
struct ChosenEffects {
  std::unique_ptr<effect::Registry> registry;
  effect::Chain chain;
  frame::Surface surface = frame::Surface::kWhite;
  frame::Background background = frame::kGrey;

  // Applies presets, then the settings file, then single values; later ones override earlier ones.
  // Throws as loadEffects(), readSettings(), chosenEffects() and Selection::set() do.
  explicit ChosenEffects(const EffectOptions& options);
};

}  // namespace grisaille::app
