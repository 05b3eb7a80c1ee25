// SPDX-License-Identifier: MIT
// Prints what paint costs, as Markdown, CSV and a plot: frames and memory against the number of
// shots, scores, spray, files, changes. Scenes: Sponza, where shots hit many kinds of surfaces, and
// a wall with up to a million shots.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <deque>
#include <span>
#include <thread>

#include "backends/backends.h"
#include "core/base/error.h"
#include "tests/bench/command.h"
#include "tests/bench/sspm_cost.h"
#include "tests/bench/sspm_edits.h"
#include "tests/bench/sspm_limits.h"
#include "tests/bench/sspm_load.h"
#include "tests/bench/sspm_muzzles.h"
#include "tests/bench/sspm_score.h"
#include "tests/bench/sspm_spray.h"
#include "tests/bench/subject.h"

namespace grisaille::bench {
namespace {

constexpr size_t kScoreShots = 10'000;

struct Options : CommonOptions {
  std::vector<size_t> counts = {64, 1000, 10000, 100000};
  std::vector<size_t> wallCounts = {64, 1000, 10000, 100000, 1000000};
  std::vector<size_t> perShotCounts = {1, 4, 16, 64, 256};
  uint32_t memory = 256;
  std::vector<size_t> editCounts = {1000, 10000};
  std::vector<uint32_t> limits = {};
  size_t limitShots = 5000;
  size_t muzzles = 200;
  size_t sprayShots = 10000;
  std::vector<size_t> loadCounts = {10000, 1000000};
  std::string out;
};

// All that is measured on Sponza alone.
void measureOthers(const std::string& backend, const Place& sponza,
                   const effect::Registry& registry, const Options& options) {
  const Subject& subject = sponza.subject;
  const std::span<const lab::Shot> shots = sponza.shots;
  if (!options.limits.empty()) {
    printLimits(backend, subject, registry, *sponza.rays, shots.first(options.limitShots),
                options.limits, options.width, options.height);
  }
  if (options.muzzles > 0) {
    printMuzzles(backend, subject, registry, *sponza.rays, shots.first(options.muzzles));
  }
  if (options.sprayShots > 0) {
    printSpray(backend, subject, registry, *sponza.rays, shots.first(options.sprayShots));
  }
  if (!options.loadCounts.empty()) {
    printLoad(backend, subject, registry, *sponza.rays, shots, options.loadCounts, options.width,
              options.height);
  }
  if (!options.editCounts.empty()) {
    printEdits(backend, subject, registry, *sponza.rays, shots, options.editCounts, options.width,
               options.height);
  }
}

void run(Options options) {
  for (auto* counts :
       {&options.counts, &options.wallCounts, &options.editCounts, &options.loadCounts}) {
    std::erase(*counts, 0);
  }
  std::deque<Place> places;  // a deque, since rays refer to their scene by address
  std::vector<size_t> extra = options.editCounts;
  if (!options.limits.empty()) extra.push_back(options.limitShots);
  extra.push_back(options.muzzles);
  extra.push_back(options.sprayShots);
  extra.insert(extra.end(), options.loadCounts.begin(), options.loadCounts.end());
  places.emplace_back(loadSubject(), options.counts, options.perShotCounts, extra);
  places.emplace_back(wallSubject(), options.wallCounts, std::vector<size_t>{},
                      std::vector<size_t>{});
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  fmt::print(
      "# What paint costs\n\nMade by `./dev bench sspm`: {}x{}, {} hardware threads, shots from "
      "about the cameras at\nanything that they see, parameters at their defaults, {} rounds in "
      "turn, medians.\n\nThe first row has a range with which its shots paint as many pixels as "
      "the "
      "largest\nnumber of shots does.\n\nPaint: the effect's passes on the first camera. Frame: "
      "all "
      "passes, with SSAO. Rays "
      "a shot: cast to place it.\nMemory: what the process grows by with these shots; on a "
      "software "
      "driver that is the host's and\nthe device's share together.\n\n",
      options.width, options.height, std::thread::hardware_concurrency(), options.rounds);
  for (const Place& place : places) {
    if (place.counts.empty()) continue;
    const size_t count = std::min(place.shots.size(), kScoreShots);
    fmt::print("## {}: score\n\n", place.subject.name);
    printScore(place.subject, registry, *place.rays, std::span(place.shots).first(count));
  }
  std::vector<Curve> curves;
  for (const backends::Backend& backend : backends::all()) {
    if (!options.backend.empty() && options.backend != backend.name) continue;
    try {
      for (const Place& place : places) {
        measureCost(backend.name, place, registry, options, options.memory, curves);
      }
      measureOthers(backend.name, places.front(), registry, options);
    } catch (const Error& error) {
      if (error.id() != ErrorId::kBackendMissing && error.id() != ErrorId::kNoDevice) throw;
      fmt::print("## {}\n\nNot here: {}\n\n", backend.name, error.detail());
    }
  }
  if (!options.out.empty()) writePlot(options.out, curves);
}

}  // namespace
}  // namespace grisaille::bench

int main(int argc, char** argv) {
  grisaille::bench::Options options;
  CLI::App program("What paint costs against the number of shots, as Markdown");
  program.add_option("--counts", options.counts, "Shots on Sponza, ascending")->expected(0, -1);
  program.add_option("--wall-counts", options.wallCounts, "Shots on the wall, ascending")
      ->expected(0, -1);
  program.add_option("--per-shot-counts", options.perShotCounts,
                     "Shots on Sponza in the mode per_shot");
  program.add_option("--memory", options.memory, "Value of the parameter memory, MB");
  program
      .add_option("--edit-counts", options.editCounts,
                  "Shots on Sponza, of which a parameter changes")
      ->expected(0, -1);
  program.add_option("--limits", options.limits,
                     "Values of the parameter memory at which paint is compared with exact paint");
  program.add_option("--limit-shots", options.limitShots, "Shots on Sponza for --limits");
  program.add_option("--muzzles", options.muzzles,
                     "Shots on Sponza that are seen by rays and by depth pictures; 0: none");
  program.add_option("--spray-shots", options.sprayShots,
                     "Shots on Sponza, of which the last 6600 are sprayed; 0: no spray");
  program
      .add_option("--load-counts", options.loadCounts,
                  "Shots on Sponza that are loaded from a file")
      ->expected(0, -1);
  program.add_option("--out", options.out, "A folder for paint_cost.csv, .svg and .png");
  return grisaille::bench::runCommand(program, options, argc, argv,
                                      [&] { grisaille::bench::run(options); });
}
