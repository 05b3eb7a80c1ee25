// SPDX-License-Identifier: MIT
// grisaille-lab claims: measures whether statements about effects hold.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
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
#include "core/base/note.h"
#include "core/base/quote.h"
#include "core/base/regular_file.h"
#include "lab/claims/part.h"
#include "lab/claims/report.h"
#include "lab/command.h"

namespace grisaille::lab {
namespace {

namespace fs = std::filesystem;

struct ClaimsOptions {
  std::string file, out, scenes, backend = "both", device;
  std::vector<std::string> only, pluginPaths;
  double scale = 1;
  uint32_t samples = 256, rounds = 5;
  bool check = false;
};

// Keeps only the claims that --only names, in the file's order.
void choose(claims::ClaimsFile& file, const std::vector<std::string>& only) {
  for (const std::string& key : only) {
    if (std::ranges::find(file.claims, key, &claims::Claim::key) == file.claims.end()) {
      throw Error(ErrorId::kUsage, "--only names '{}', but the file has no such claim", key);
    }
  }
  if (only.empty()) return;
  std::erase_if(file.claims, [&](const claims::Claim& claim) {
    return std::ranges::find(only, claim.key) == only.end();
  });
}

std::string commandOf(const ClaimsOptions& options) {
  std::string command = "grisaille-lab claims " + shellQuoted(options.file);
  const ClaimsOptions usual;
  if (options.backend != usual.backend) command += " --backend " + options.backend;
  if (!options.only.empty()) command += fmt::format(" --only {}", fmt::join(options.only, ","));
  if (!options.scenes.empty()) command += " --scenes " + shellQuoted(options.scenes);
  if (options.scale != usual.scale) command += fmt::format(" --scale {}", options.scale);
  if (options.samples != usual.samples) command += fmt::format(" --samples {}", options.samples);
  if (options.rounds != usual.rounds) command += fmt::format(" --rounds {}", options.rounds);
  return command + " --out " + shellQuoted(options.out);
}

fs::path partsOf(const ClaimsOptions& options) {
  return fs::path(options.out) / "claims.part";
}

// Everything that a claim's result depends on. A later run reuses a result only if its key is
// equal.
std::string keyOf(const claims::Claim& claim, const ClaimsOptions& options,
                  const gpu::DeviceInfo& device) {
  const std::string text = readRegularFile(options.file, ErrorId::kSettingsUnreadable);
  std::error_code none;  // set for the built-in scene, which has no file
  const auto written = fs::last_write_time(claim.scene, none).time_since_epoch().count();
  return fmt::format("{}\n{}\n{}\n{}\n{} samples, {} rounds, scale {}\nscene of {}\n{}\n{}",
                     GRISAILLE_COMMIT, device.backend, device.name, device.driver, options.samples,
                     options.rounds, options.scale, none ? 0 : written, claim.key, text);
}

// Runs all claims on one backend, and reuses the results of an interrupted run.
claims::ClaimsOfBackend runOn(const std::string& backend, const ClaimsOptions& options,
                              const claims::ClaimsDesc& desc, const claims::ClaimsFile& file,
                              app::DriverMessages& messages) {
  const auto device = backends::create(backend, {.device = options.device,
                                                 .check = options.check,
                                                 .timed = true,
                                                 .message = messages.sink()});
  const gpu::DeviceInfo& info = device->info();
  app::printDevice(info);
  claims::ClaimsOfBackend result{.backend = info.backend,
                                 .device = info.name,
                                 .driver = info.driver,
                                 .clock = gpu::clockName(info.clock),
                                 .results = {}};
  claims::ClaimsRunner runner(desc, *device);
  for (const claims::Claim& claim : file.claims) {
    const std::string key = keyOf(claim, options, info);
    auto done = claims::loadClaim(partsOf(options), key);
    const char* whence = done ? " (measured before)" : "";
    if (!done) {
      done = runner.run(claim);
      claims::saveClaim(partsOf(options), key, *done);
    }
    result.results.push_back(std::move(*done));
    fmt::print("{}: {} {}{}\n", info.backend, claim.key, claims::verdictOf(result.results.back()),
               whence);
    std::fflush(stdout);
    if (!app::truth::Interruption::asked()) continue;
    fmt::print(stderr, "note: interrupted; run the same command again to continue\n");
    throw app::truth::Interrupted();
  }
  return result;
}

// Removes the optional claims whose scene is missing, and says so.
void leaveOut(claims::ClaimsFile& file) {
  std::erase_if(file.claims, [](const claims::Claim& claim) {
    std::error_code failed;
    if (!claim.optional || fs::exists(claim.scene, failed)) return false;
    note(
        fmt::format("left out the claim '{}': there is no file {}; pass the folder of such files "
                    "with --scenes",
                    claim.key, claim.scene));
    return true;
  });
  if (file.claims.empty()) {
    throw Error(ErrorId::kUsage, "the scene of every chosen claim is missing; pass --scenes");
  }
}

void runClaims(const ClaimsOptions& options) {
  const auto registry = app::loadEffects(options.pluginPaths);
  claims::ClaimsReport report{.file = claims::loadClaims(options.file, *registry, options.scenes),
                              .command = commandOf(options),
                              .machine = app::machineName(),
                              .commit = GRISAILLE_COMMIT,
                              .backends = {}};
  choose(report.file, options.only);
  leaveOut(report.file);
  for (claims::Claim& claim : report.file.claims) claim = claims::scaled(claim, options.scale);
  const std::vector<std::string> names = app::chosenBackends(options.backend);
  const claims::ClaimsDesc desc{.registry = registry.get(),
                                .samples = options.samples,
                                .rounds = options.rounds,
                                .progress = app::truth::usualProgress()};
  app::requireDevices(names, options.device);
  requireWritableFolder(options.out);
  const app::truth::Interruption interruption;
  app::DriverMessages messages;
  for (const std::string& name : names) {
    report.backends.push_back(runOn(name, options, desc, report.file, messages));
  }
  claims::writeClaims(options.out, report);
  std::error_code failed;
  fs::remove_all(partsOf(options), failed);
  fmt::print("wrote {}\n", options.out + "/claims.html");
  if (options.check) messages.throwIfAny();
}

}  // namespace

void addClaims(CLI::App& program) {
  auto options = std::make_shared<ClaimsOptions>();
  CLI::App* command =
      program.add_subcommand("claims", "Measure whether statements about effects hold");
  command->add_option("file", options->file, "A study file, such as studies/claims.toml")
      ->type_name("FILE.toml")
      ->required();
  command
      ->add_option("--out", options->out,
                   "Folder for the report; an interrupted run goes on from the results in it")
      ->type_name("DIR")
      ->required();
  command->add_option("--only", options->only, "Measure only these claims of the file")
      ->type_name("KEY,...")
      ->delimiter(',');
  command
      ->add_option("--scenes", options->scenes,
                   "Another folder for scenes that do not stand beside the file")
      ->type_name("DIR");
  command->add_option("--backend", options->backend, "opengl, vulkan or both")
      ->capture_default_str();
  command->add_option("--device", options->device, "Number or part of a device's name");
  command
      ->add_option("--scale", options->scale,
                   "Multiplies the pictures' sizes; the result is at least 16 pixels")
      ->check(app::numberFrom(0.05, 4))
      ->capture_default_str();
  command->add_option("--samples", options->samples, "Rays per pixel for the truth")
      ->check(app::wholeNumberFrom(16, 65536))
      ->capture_default_str();
  command->add_option("--rounds", options->rounds, "Times that each run's cost is measured")
      ->check(app::wholeNumberFrom(1, 1000))
      ->capture_default_str();
  command->add_option("--plugin-path", options->pluginPaths, "Another folder to load effects from")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->add_flag("--check", options->check,
                    "Validate every call, in the layer and in the driver");
  command->callback([options] { runClaims(*options); });
}

}  // namespace grisaille::lab
