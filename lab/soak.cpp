// SPDX-License-Identifier: MIT
// grisaille-lab soak: paint for minutes under a moving camera, with undo, reload and resize.
#include <fmt/format.h>

#include <memory>

#include "app/options/driver_messages.h"
#include "app/options/option_checks.h"
#include "app/options/scene_options.h"
#include "app/options/start_device.h"
#include "app/report/machine.h"
#include "app/truth/interruption.h"
#include "backends/backends.h"
#include "core/base/error.h"
#include "lab/command.h"
#include "lab/soak/soak.h"

namespace grisaille::lab {
namespace {

struct SoakOptions {
  app::SceneOptions view;
  std::string backend = "both", device;
  soak::Plan plan;
};

constexpr size_t kMostNamed = 10;  // faults in full

// Returns the number of faults.
size_t soakOn(const std::string& backend, const SoakOptions& options, const app::SceneView& view,
              app::DriverMessages& messages) {
  const auto device = backends::create(
      backend, {.device = options.device, .check = true, .message = messages.sink()});
  app::printDevice(device->info());
  const soak::Outcome outcome = soak::run(options.plan, view.scene, view.camera, *device);
  fmt::print("{}", soak::tableOf(outcome));
  const std::vector<std::string> faults = soak::faultsOf(outcome);
  for (size_t i = 0; i < std::min(kMostNamed, faults.size()); ++i) {
    fmt::print("fault: {}\n", faults[i]);
  }
  if (faults.size() > kMostNamed) fmt::print("fault: {} more\n", faults.size() - kMostNamed);
  std::fflush(stdout);
  return faults.size();
}

void runSoak(SoakOptions options) {
  const std::vector<std::string> backends = app::chosenBackends(options.backend);
  app::SceneView view = app::loadView(options.view);
  view.takePose();
  if (!options.view.size.empty()) options.plan.size = view.size;
  fmt::print("{}, {:g} minutes, {} + {} shots, memory {} MB, seed {}\n", app::machineName(),
             options.plan.minutes, options.plan.before, options.plan.shots, options.plan.memory,
             options.plan.seed);
  const app::truth::Interruption interruption;
  app::DriverMessages messages;
  size_t faults = 0;
  for (const std::string& backend : backends) faults += soakOn(backend, options, view, messages);
  messages.throwIfAny();
  if (faults > 0) throw Error(ErrorId::kSoakFault, "the soak has {} faults", faults);
}

}  // namespace

void addSoak(CLI::App& program) {
  auto options = std::make_shared<SoakOptions>();
  CLI::App* command = program.add_subcommand(
      "soak",
      "Fire shots for minutes under a moving camera, with undo, reload and resize at random, and "
      "check that frames and memory stay even");
  soak::Plan& plan = options->plan;
  options->view.addTo(*command);
  command->add_option("--backend", options->backend, "opengl, vulkan or both, one after the other")
      ->capture_default_str();
  command->add_option("--device", options->device, "Number or part of a device's name");
  command->add_option("--minutes", plan.minutes, "How long, on each backend")
      ->check(app::positiveNumber())
      ->capture_default_str();
  command->add_option("--before", plan.before, "Number of shots that are there at the beginning")
      ->check(app::wholeNumberFrom(0, 1'000'000))
      ->capture_default_str();
  command->add_option("--shots", plan.shots, "Number of shots, fired at an even rate")
      ->check(app::wholeNumberFrom(1, 1'000'000))
      ->capture_default_str();
  command->add_option("--memory", plan.memory, "The effect's limit of memory, MB")
      ->check(app::wholeNumberFrom(16, 65'536))
      ->capture_default_str();
  command->add_option("--seed", plan.seed, "Seed of the shots and of all that happens")
      ->capture_default_str();
  command->callback([options] { runSoak(*options); });
}

}  // namespace grisaille::lab
