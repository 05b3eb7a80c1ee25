// SPDX-License-Identifier: MIT
// grisaille effects: what is there, what was refused and why.
#include <cstdio>
#include <memory>

#include "app/active_effects.h"
#include "app/command.h"
#include "app/effect_tables.h"
#include "core/error.h"

namespace grisaille::app {
namespace {

struct EffectsOptions {
  bool json = false;
  std::string markdown;
  std::vector<std::string> pluginPaths;
};

void listEffects(const EffectsOptions& options) {
  const auto registry = loadEffects(options.pluginPaths);
  const std::string text = !options.markdown.empty()
                               ? effectMarkdown(registry->find(options.markdown))
                           : options.json ? effectsJson(*registry)
                                          : effectsText(*registry);
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void addEffects(CLI::App& program) {
  auto options = std::make_shared<EffectsOptions>();
  CLI::App* command = program.add_subcommand(
      "effects", "List the effects with their parameters, and the plugins that were refused");
  command->add_flag("--json", options->json, "As JSON");
  command->add_option("--markdown", options->markdown, "One effect's tables, for a manual")
      ->type_name("EFFECT");
  command->add_option("--plugin-path", options->pluginPaths, "A further folder of effects")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->callback([options] { listEffects(*options); });
}

}  // namespace grisaille::app
