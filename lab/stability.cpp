// SPDX-License-Identifier: MIT
// grisaille-lab stability: compares every effect with its oracle, at the limits of its inputs.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/options/driver_messages.h"
#include "app/options/option_checks.h"
#include "app/options/start_device.h"
#include "app/report/machine.h"
#include "app/settings/load_effects.h"
#include "app/truth/interruption.h"
#include "app/truth/progress.h"
#include "backends/backends.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/quote.h"
#include "lab/command.h"
#include "lab/stability/edge_pictures.h"
#include "lab/stability/report.h"
#include "lab/stability/runner.h"

namespace grisaille::lab {
namespace {

namespace fs = std::filesystem;

struct StabilityOptions {
  std::string out, backend = "both", device;
  std::vector<std::string> only;
  uint32_t combinations = 60, seed = 1;
  bool quick = false, check = false;
};

constexpr const char* kMovement = "movement";  // a group of --only without cases

std::vector<stability::Case> chosenCases(const StabilityOptions& options) {
  std::vector<stability::Case> cases = stability::sweepCases(options.combinations, options.seed);
  for (const std::string& group : options.only) {
    if (group != kMovement &&
        std::ranges::find(cases, group, &stability::Case::group) == cases.end()) {
      throw Error(ErrorId::kUsage, "--only names '{}', but the sweep has no such group", group);
    }
  }
  std::erase_if(cases, [&](const stability::Case& one) {
    const bool named =
        options.only.empty() || std::ranges::find(options.only, one.group) != options.only.end();
    return !named || (options.quick && !one.quick);
  });
  return cases;
}

bool wantsMovement(const StabilityOptions& options) {
  return options.only.empty() || std::ranges::find(options.only, kMovement) != options.only.end();
}

std::string commandOf(const StabilityOptions& options) {
  const StabilityOptions usual;
  std::string command = "grisaille-lab stability";
  if (options.backend != usual.backend) command += " --backend " + options.backend;
  for (const std::string& group : options.only) command += " --only " + shellQuoted(group);
  if (options.quick) command += " --quick";
  if (options.combinations != usual.combinations) {
    command += fmt::format(" --combinations {}", options.combinations);
  }
  if (options.seed != usual.seed) command += fmt::format(" --seed {}", options.seed);
  return command + " --out " + shellQuoted(options.out);
}

// Runs all cases, and reuses the results of an interrupted run of the same program.
void runCases(const fs::path& done, stability::Runner& runner, stability::Sweep& sweep) {
  std::string machine = sweep.commit;
  for (const std::string& device : sweep.devices) machine += "\n" + device;
  app::truth::Progress progress("stability", app::truth::usualProgress());
  for (size_t i = 0; i < sweep.cases.size(); ++i) {
    const stability::Case& one = sweep.cases[i];
    progress.show({static_cast<double>(i), static_cast<double>(sweep.cases.size()),
                   fmt::format("{} of {}", i, sweep.cases.size())});
    const std::string key = stability::keyOf(one) + machine;
    auto result = stability::loadResult(done, key);
    if (!result) {
      result = runner.run(one);
      result->key = key;
      stability::saveResult(done, *result);
    }
    for (const std::string& fault : stability::faultsOf(one, *result)) {
      progress.clear();
      fmt::print("{}: {}\n", one.title(), fault);
      std::fflush(stdout);
    }
    sweep.results.push_back(std::move(*result));
    if (app::truth::Interruption::asked()) {
      progress.clear();
      fmt::print(stderr, "note: interrupted; run the same command again to continue\n");
      throw app::truth::Interrupted();
    }
  }
}

void runMovements(stability::Runner& runner, bool quick, stability::Sweep& sweep) {
  app::truth::Progress progress("movement", app::truth::usualProgress());
  std::vector<stability::MovementRow> rows = stability::movementRows(quick);
  for (size_t i = 0; i < rows.size(); ++i) {
    progress.show({static_cast<double>(i), static_cast<double>(rows.size()),
                   fmt::format("{} of {}", i, rows.size())});
    stability::measureMovement(runner, rows[i]);
    for (const std::string& fault : stability::faultsOf(rows[i])) {
      progress.clear();
      fmt::print("{} degrees, {} m: {}\n", rows[i].degrees, rows[i].distance, fault);
    }
    if (app::truth::Interruption::asked()) throw app::truth::Interrupted();
  }
  sweep.movements = std::move(rows);
}

void runSweep(const StabilityOptions& options) {
  const auto registry = app::loadEffects({});
  stability::Sweep sweep{.command = commandOf(options),
                         .machine = app::machineName(),
                         .commit = GRISAILLE_COMMIT,
                         .devices = {},
                         .cases = chosenCases(options),
                         .results = {},
                         .movements = {}};
  if (sweep.cases.empty() && !wantsMovement(options))
    throw Error(ErrorId::kUsage, "the options select no case");
  const std::vector<std::string> names = app::chosenBackends(options.backend);
  requireWritableFolder(options.out);
  app::DriverMessages messages;
  const app::truth::Interruption interruption;
  const fs::path done = fs::path(options.out) / "stability.part";
  {
    std::vector<std::unique_ptr<gpu::Device>> owned;
    std::vector<gpu::Device*> devices;
    for (const std::string& name : names) {
      owned.push_back(backends::create(
          name, {.device = options.device, .check = options.check, .message = messages.sink()}));
      devices.push_back(owned.back().get());
      const gpu::DeviceInfo& info = devices.back()->info();
      app::printDevice(info);
      sweep.devices.push_back(fmt::format("{}: {} ({})", info.backend, info.name, info.driver));
    }
    stability::Runner runner(*registry, devices);
    runCases(done, runner, sweep);
    if (wantsMovement(options)) runMovements(runner, options.quick, sweep);
    stability::writeEdgePictures(options.out, runner, sweep);
  }
  stability::writeSweep(options.out, sweep);
  std::error_code failed;
  fs::remove_all(done, failed);
  fmt::print("{} of {} cases hold\nwrote {}\n", sweep.count() - sweep.failed(), sweep.count(),
             (fs::path(options.out) / "stability.md").string());
  if (options.check) messages.throwIfAny();
  if (sweep.failed() > 0) {
    throw Error(ErrorId::kUnstable, "{} of {} cases exceed a limit", sweep.failed(), sweep.count());
  }
}

}  // namespace

void addStability(CLI::App& program) {
  auto options = std::make_shared<StabilityOptions>();
  CLI::App* command = program.add_subcommand(
      "stability", "Compare the effects with double precision, at the limits of their inputs");
  command
      ->add_option("--out", options->out,
                   "Folder for the tables; an interrupted run goes on from the results in it")
      ->type_name("DIR")
      ->required();
  command->add_option("--backend", options->backend, "opengl, vulkan or both")
      ->capture_default_str();
  command->add_option("--device", options->device, "Number or part of a device's name");
  command->add_option("--only", options->only, "Run only this group of cases; repeatable")
      ->type_name("GROUP")
      ->allow_extra_args(false);
  command->add_flag("--quick", options->quick, "Run a part of the cases, for a first look");
  command->add_option("--combinations", options->combinations, "Number of random cases")
      ->check(app::wholeNumberFrom(0, 100000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of the random cases")->capture_default_str();
  command->add_flag("--check", options->check,
                    "Validate every call, in the layer and in the driver");
  command->callback([options] { runSweep(*options); });
}

}  // namespace grisaille::lab
