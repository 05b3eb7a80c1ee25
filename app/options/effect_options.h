// SPDX-License-Identifier: MIT
// Which effects run, with what values, on which device, into which files: the options that `render`
// and `apply` share.
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
  std::string surface = "white", backend, device, config;
  bool check = false;
  // Null before addTo(): whether the command line has them.
  const CLI::Option *effectsGiven = nullptr, *surfaceGiven = nullptr;

  // This outlives the command. Returns --write, which has `help`.
  CLI::Option* addTo(CLI::App& command, const std::string& help);
};

// The chain that options ask for.
struct ChosenEffects {
  std::unique_ptr<effect::Registry> registry;
  effect::Chain chain;
  frame::Surface surface = frame::Surface::kWhite;

  // Presets, the file of settings, and single values go over one another in this order. Throws as
  // what these are read by does.
  explicit ChosenEffects(const EffectOptions& options);
};

}  // namespace grisaille::app
