// SPDX-License-Identifier: MIT
// Prints how far drivers differ, as Markdown: in drawing a scene, in whole frames of the effects,
// and in the effects' results from the same depth and normals.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "backends/backends.h"
#include "tests/backends/drivers/agreement.h"

namespace grisaille::bench {
namespace {

using namespace tests;

struct Options {
  uint32_t width = 640, height = 360;
  std::string effect;  // "": both
};

struct Driver {
  TestDevice device;
  std::unique_ptr<gpu::Device> opened;
};

std::vector<Driver> openAll() {
  std::vector<Driver> all;
  for (const TestDevice& device : presentDevices()) {
    const DriverScope scope(device);
    all.push_back({.device = device, .opened = backends::create(device.backend, {})});
  }
  for (const TestDevice& device : testDevices()) {
    const std::string why = whyAbsent(device);
    if (!why.empty()) fmt::print("{}: not here: {}\n\n", device.label, why);
  }
  return all;
}

void printDrivers(const std::vector<Driver>& drivers) {
  fmt::print(
      "| device | driver | bits of sub-pixel position | depth is that of a place up to ... px "
      "away |\n|---|---|---|---|\n");
  for (const Driver& driver : drivers) {
    const gpu::DeviceInfo& info = driver.opened->info();
    const Snapping snapping = measureSnapping(*driver.opened);
    fmt::print("| {} | {}, {} | {} | {:.4f} |\n", driver.device.label, info.name, info.driver,
               snapping.bits, snapping.depthShift);
  }
  fmt::print("\n");
}

// Relative differences of two depths at pixels where both show a surface, in ascending order.
std::vector<double> depthDifferences(const image::Image& a, const image::Image& b) {
  std::vector<double> all;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (a.pixels[i] > 0 && b.pixels[i] > 0) {
      all.push_back(std::abs(double{b.pixels[i]} / a.pixels[i] - 1));
    }
  }
  std::ranges::sort(all);
  return all;
}

void printDepths(const std::vector<Driver>& drivers, const DriverSubject& subject) {
  fmt::print(
      "| device | depth off, median | depth off, 99th percentile | pixels off by more than 1 % "
      "|\n|---|---|---|---|\n");
  const image::Image first = drawShared(*drivers[0].opened, subject).pictures.viewDepth;
  for (size_t i = 1; i < drivers.size(); ++i) {
    const auto off =
        depthDifferences(first, drawShared(*drivers[i].opened, subject).pictures.viewDepth);
    const auto over = off.end() - std::ranges::upper_bound(off, 0.01);
    fmt::print("| {} | {:.5f} % | {:.4f} % | {:.3f} % |\n", drivers[i].device.label,
               100 * off[off.size() / 2], 100 * off[off.size() * 99 / 100],
               100 * static_cast<double>(over) / static_cast<double>(off.size()));
  }
  fmt::print("\n");
}

std::string errorCells(const DriverSubject::Errors& errors) {
  return fmt::format(" {:.5f} | {:.5f} | {:.3f} % |", errors.whole, errors.sameSurface,
                     100 * errors.otherSurface);
}

// Prints the presets of one effect on one subject.
void printPresets(const std::vector<Driver>& drivers, DriverSubject& subject,
                  const effect::Registry& registry, const std::string& effect) {
  const bool occludes = effect == "ssao";
  fmt::print(
      "| preset | device | same depth and normals: pixels apart | whole frames: pixels apart{}\n"
      "|---|---|---|---|{}\n",
      occludes ? " | RMSE against rays | on pixels that show the ray's surface | other pixels |"
               : " |",
      occludes ? "---|---|---|" : "");
  const SharedAttachments shared = drawShared(*drivers[0].opened, subject);
  for (const PresetOf& preset : allPresets(registry)) {
    if (preset.effect != effect) continue;
    const effect::Selection selection = selectionOf(registry, preset);
    image::Image firstApplied, firstWhole;
    for (const Driver& driver : drivers) {
      fmt::print(stderr, "{}, {} {}: {}\n", subject.name, effect, preset.preset,
                 driver.device.label);
      image::Image applied = applyShared(*driver.opened, subject, selection, shared);
      auto [whole, depth] = drawWhole(*driver.opened, subject, selection);
      const bool isFirst = firstApplied.pixels.empty();
      const auto percent = [&](const image::Image& a, const image::Image& b) {
        return isFirst ? std::string("first") : fmt::format("{:.4f} %", 100 * shareApart(a, b));
      };
      fmt::print("| {} | {} | {} | {} |{}\n", preset.preset, driver.device.label,
                 percent(firstApplied, applied), percent(firstWhole, whole),
                 occludes ? errorCells(subject.errors(whole, depth)) : "");
      if (!isFirst) continue;
      firstApplied = std::move(applied);
      firstWhole = std::move(whole);
    }
  }
  fmt::print("\n");
}

void run(const Options& options) {
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  const std::vector<Driver> drivers = openAll();
  if (drivers.size() < 2) throw std::runtime_error("only one device is present");
  printDrivers(drivers);
  for (auto* make : {&DriverSubject::atrium, &DriverSubject::sponza}) {
    const auto subject = make(options.width, options.height);
    if (!subject) continue;
    fmt::print("## On {}, {}x{}\n\nAgainst {}. ", subject->name, options.width, options.height,
               drivers[0].device.label);
    fmt::print("Apart: a channel differs by more than 2/255.\n\n");
    printDepths(drivers, *subject);
    for (const char* effect : {"ssao", "sspm"}) {
      if (!options.effect.empty() && options.effect != effect) continue;
      fmt::print("### {}\n\n", effect);
      printPresets(drivers, *subject, registry, effect);
    }
  }
}

}  // namespace
}  // namespace grisaille::bench

int main(int argc, char** argv) {
  grisaille::bench::Options options;
  CLI::App program("How far drivers differ, as Markdown");
  program.add_option("--width", options.width, "Pixels")->check(CLI::Range(16u, 4096u));
  program.add_option("--height", options.height, "Pixels")->check(CLI::Range(16u, 4096u));
  program.add_option("--effect", options.effect, "ssao or sspm; default: both");
  CLI11_PARSE(program, argc, argv);
  try {
    grisaille::bench::run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
