// SPDX-License-Identifier: MIT
// grisaille effects: what is there, what was refused and why; the whole check of one plugin.
#include <cstdio>
#include <memory>

#include "app/command.h"
#include "app/options/option_checks.h"
#include "app/report/effect_tables.h"
#include "app/settings/load_effects.h"
#include "app/verify/verify.h"
#include "core/base/error.h"

namespace grisaille::app {
namespace {

struct EffectsOptions {
  bool json = false;
  std::string markdown, verify;
  bool inProcess = false;
  int patience = 120;  // seconds
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

void verify(const EffectsOptions& options) {
  if (!options.inProcess) {
    return verifyPlugin(options.verify, std::chrono::seconds(options.patience));
  }
  Report report;
  checkPlugin(options.verify, report);
  report.end();
  if (report.faults() > 0) {
    throw Error(ErrorId::kEffectFaulty, "{}: {} faults", options.verify, report.faults());
  }
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
  CLI::Option* verified =
      command
          ->add_option(
              "--verify", options->verify,
              "Check a plugin whole instead: its table, then on every backend, validated, "
              "sizes, parameters at their extremes and at random, every pixel; print a report")
          ->type_name("FILE.so");
  command
      ->add_flag("--in-process", options->inProcess,
                 "Check it in this process, where a debugger sees it crash")
      ->needs(verified);
  command
      ->add_option("--patience", options->patience,
                   "Seconds that one step of the check may take before it counts as endless")
      ->needs(verified)
      ->check(wholeNumberFrom(1, 86400))
      ->capture_default_str();
  command->callback(
      [options] { options->verify.empty() ? listEffects(*options) : verify(*options); });
}

}  // namespace grisaille::app
