// SPDX-License-Identifier: MIT
// grisaille effects: lists the effects, and the plugins that were refused with the reason; with
// --verify, checks one plugin.
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
  command->add_flag("--json", options->json, "Print JSON");
  command
      ->add_option("--markdown", options->markdown,
                   "Print the tables of one effect as Markdown, for a manual")
      ->type_name("EFFECT");
  command->add_option("--plugin-path", options->pluginPaths, "Another folder to load effects from")
      ->type_name("DIR")
      ->allow_extra_args(false);
  CLI::Option* verified =
      command
          ->add_option(
              "--verify", options->verify,
              "Check a plugin instead, and print a report: its tables; then, on every backend with "
              "validation on, picture sizes, parameters at their extremes and at random, and "
              "that it writes every pixel")
          ->type_name("FILE.so");
  command
      ->add_flag("--in-process", options->inProcess,
                 "Run --verify in this process, for a debugger to stop at a crash")
      ->needs(verified);
  command
      ->add_option("--patience", options->patience,
                   "Longest time of one step of --verify, in seconds; a longer step is a fault")
      ->needs(verified)
      ->check(wholeNumberFrom(1, 86400))
      ->capture_default_str();
  command->callback(
      [options] { options->verify.empty() ? listEffects(*options) : verify(*options); });
}

}  // namespace grisaille::app
