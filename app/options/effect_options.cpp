// SPDX-License-Identifier: MIT
#include "app/options/effect_options.h"
#include "app/options/option_checks.h"
#include "app/settings/background.h"
#include "app/settings/chosen_effects.h"
#include "app/settings/load_effects.h"

namespace grisaille::app {

CLI::Option* EffectOptions::addTo(CLI::App& command, const std::string& help) {
  command.add_option("--backend", backend, "opengl or vulkan; default: the first that starts")
      ->type_name("NAME");
  command
      .add_option("--device", device,
                  "Number of a device or part of its name, see `grisaille backends`")
      ->type_name("N|NAME");
  effectsGiven =
      command
          .add_option(
              "--effects", effects,
              "Effects, in the order they run; default: those that `grisaille effects` marks")
          ->type_name("KEY,...")
          ->delimiter(',')
          ->expected(0, 64);
  command
      .add_option("--preset", presets,
                  "fast, balanced, fine or reference; --config and --set override it")
      ->type_name("EFFECT=NAME")
      ->allow_extra_args(false);
  command.add_option("--set", sets, "Value of a parameter, see `grisaille effects`")
      ->type_name("EFFECT.PARAMETER=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--config", config,
                  "Settings file: effects, surface, background and values; other options override "
                  "it")
      ->type_name("FILE.toml");
  surfaceGiven =
      command.add_option("--surface", surface, "Surfaces in color: white, or their base colours")
          ->check(CLI::IsMember({"white", "base"}))
          ->capture_default_str();
  background = textOf(frame::kGrey);
  backgroundGiven = addBackground(command, background)->capture_default_str();
  command.add_option("--plugin-path", pluginPaths, "Another folder to load effects from")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command.add_flag("--check", check,
                   "Validate every graphics call, in the rendering layer and in the driver");
  return command.add_option("--write", writes, help)
      ->type_name("NAME=FILE")
      ->allow_extra_args(false);
}

ChosenEffects::ChosenEffects(const EffectOptions& options)
    : registry(loadEffects(options.pluginPaths)) {
  const auto given = [](const CLI::Option* option) {
    return option != nullptr && !option->empty();
  };
  const Settings settings = options.config.empty() ? Settings{} : readSettings(options.config);
  std::vector<std::string> keys = given(options.effectsGiven) ? options.effects
                                  : settings.effects          ? *settings.effects
                                                              : registry->defaults();
  std::erase(keys, "");
  chain = effect::Chain(chosenEffects(*registry, keys, options.presets, settings));
  for (const std::string& set : options.sets) chain.selection.set(effect::parseAssignment(set));
  const std::string& ground =
      given(options.surfaceGiven) || !settings.surface ? options.surface : *settings.surface;
  if (ground == "base") surface = frame::Surface::kBaseColour;
  background =
      backgroundOf(given(options.backgroundGiven) || !settings.background ? options.background
                                                                          : *settings.background)
          .value_or(background);
}

}  // namespace grisaille::app
