// SPDX-License-Identifier: MIT
// grisaille measure: what settings cost, and how wrong they are.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>

#include "app/command.h"
#include "app/driver_messages.h"
#include "app/machine.h"
#include "app/size.h"
#include "app/study/flicker_run.h"
#include "app/study/report.h"
#include "app/study/study.h"
#include "app/truth/content_hash.h"
#include "app/truth/interruption.h"
#include "app/truth/occlusion_truth.h"
#include "app/truth/progress.h"
#include "app/viewer/command_line.h"
#include "backends/backends.h"

namespace grisaille::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string scene, size = "640x360", backend = "both", device, output, out, shard = "1/1", path;
  std::vector<std::string> cameras, sweeps, sets, effects, pluginPaths;
  double radius = 0.5;
  uint32_t samples = 256, rounds = 5;
  bool check = false, reportOnly = false;
};

// The first active effect's visibility, or its first output of one channel.
std::string defaultOutput(const ActiveEffects& active) {
  for (const effect::Effect* effect : active.effects()) {
    for (const grisaille_output_desc& output : effect->outputs()) {
      if (output.role == GRISAILLE_ROLE_VISIBILITY) {
        return std::string(effect->desc->key) + "." + output.key;
      }
    }
  }
  throw Error(ErrorId::kUsage, "no effect has a visibility; name an --output");
}

// What the command line asks for.
struct Job {
  std::unique_ptr<effect::Registry> registry;
  std::vector<study::Setting> settings;
  std::vector<std::string> backendNames;
  scene::Scene scene;
  std::vector<scene::Camera> path;             // of the flicker; none: it is not measured
  std::vector<trace::FlickerFrame> pathTruth;  // one a camera of the path
  study::StudyDesc desc;

  explicit Job(const Options& options);
  void addViews(const Options& options);
  void addPath(const Options& options);
};

Job::Job(const Options& options) : registry(loadEffects(options.pluginPaths)) {
  std::vector<study::Sweep> sweeps;
  desc.effects = options.effects;
  for (const std::string& text : options.sweeps) {
    sweeps.push_back(study::parseSweep(*registry, text));
    if (std::ranges::find(desc.effects, sweeps.back().effect) == desc.effects.end()) {
      desc.effects.push_back(sweeps.back().effect);
    }
  }
  if (desc.effects.empty()) desc.effects = kDefaultEffects;
  ActiveEffects active(*registry, desc.effects);
  for (const std::string& set : options.sets) active.set(set);
  const study::Shard shard = study::parseShard(options.shard);
  const std::vector<study::Setting> grid = study::gridOf(sweeps);
  for (size_t i = 0; i < grid.size(); ++i) {
    if (shard.holds(i)) settings.push_back(grid[i]);
  }
  backendNames = options.backend == "both" ? std::vector<std::string>{"opengl", "vulkan"}
                                           : std::vector<std::string>{options.backend};
  for (const std::string& name : backendNames) backends::find(name);
  desc.output = options.output.empty() ? defaultOutput(active) : options.output;
  frame::checkOutput(desc.output, active.effects());
  desc.size = parseSize(options.size);
  if (!options.path.empty()) {
    path = scene::camerasOf(scene::loadCameraPath(options.path));
    study::checkPathSize(options.path, path.size(), desc.size);
  }
  desc.rounds = options.rounds;
  desc.registry = registry.get();
  desc.sets = options.sets;
  desc.folder = options.out;
  desc.machine = machineName();
  desc.commit = GRISAILLE_COMMIT;
  scene = options.scene.empty() ? scene::makeAtrium() : scene::loadGltf(options.scene);
  desc.scene = &scene;
}

void Job::addViews(const Options& options) {
  std::string key = fmt::format("scene {:016x}\nsize {}x{}\nradius {}\nsamples {}\noutput {}\n",
                                truth::hashOf(scene), desc.size.x, desc.size.y, options.radius,
                                options.samples, desc.output);
  for (const std::string& set : options.sets) key += "set " + set + "\n";
  for (const std::string& effect : desc.effects) key += "effect " + effect + "\n";
  std::vector<std::string> names = options.cameras;
  if (names.empty()) names.emplace_back();
  for (const std::string& name : names) {
    study::View view;
    view.name = name.empty() ? "default" : fs::path(name).stem().string();
    view.camera = !name.empty()           ? scene::loadCamera(name)
                  : options.scene.empty() ? scene::atriumCamera()
                                          : scene::overviewCamera(scene.bounds);
    view.camera.size = desc.size;
    truth::OcclusionTruth traced = truth::traceOcclusion(
        scene, view.camera, desc.size, options.radius, options.samples, isatty(STDERR_FILENO) == 1);
    view.truth = std::move(traced.visibility);
    for (size_t i = 0; i < view.truth.pixels.size(); ++i) {
      if (traced.hits[i].viewDepth == 0) {
        view.truth.pixels[i] = std::numeric_limits<float>::quiet_NaN();
      }
    }
    key += "camera " + scene::cameraJson(view.camera) + "\n";
    desc.views.push_back(std::move(view));
  }
  desc.key = key;
  desc.commandOf = [this, scenePath = options.scene](const study::Setting& setting,
                                                     const std::string& backend) {
    std::string command = "grisaille render";
    const auto add = [&](const std::string& word) { command += " " + viewer::shellQuoted(word); };
    if (!scenePath.empty()) add(scenePath);
    add("--backend"), add(backend), add("--camera"), add(scene::cameraJson(desc.views[0].camera));
    add("--size"), add(fmt::format("{}x{}", desc.size.x, desc.size.y));
    add("--effects"), add(fmt::format("{}", fmt::join(desc.effects, ",")));
    for (const std::string& set : desc.sets) add("--set"), add(set);
    for (const auto& [name, value] : setting) add("--set"), add(name + "=" + value);
    add("--write"), add(desc.output + "=picture.png");
    return command;
  };
}

void Job::addPath(const Options& options) {
  if (options.path.empty()) return;
  for (const scene::Camera& camera : path) {
    desc.key += "path " + scene::cameraJson(camera) + "\n";
    pathTruth.push_back(study::traceFrame(scene, camera, desc.size, options.radius, options.samples,
                                          isatty(STDERR_FILENO) == 1));
  }
  desc.path = &pathTruth;
}

void measure(const Options& options) {
  if (options.reportOnly) return study::writeReport(options.out);
  Job job(options);
  const truth::Interruption interruption;
  job.addViews(options);
  job.addPath(options);
  std::error_code failed;
  fs::create_directories(options.out, failed);
  DriverMessages messages;
  bool whole = true;
  for (const std::string& name : job.backendNames) {
    const auto device = backends::create(name, {.device = options.device,
                                                .check = options.check,
                                                .timed = true,
                                                .message = messages.sink()});
    const gpu::DeviceInfo& info = device->info();
    fmt::print("{}: {} ({}){}\n", info.backend, info.name, info.driver,
               info.software ? ", software" : "");
    std::fflush(stdout);
    truth::Progress progress(name, isatty(STDERR_FILENO) == 1);
    study::Study study(job.desc, *device, job.settings);
    whole = study.run(
        [&](size_t done, size_t all) {
          progress.show({static_cast<double>(done), static_cast<double>(all),
                         fmt::format("{} of {}", done, all)});
        },
        truth::Interruption::asked);
    if (!whole) break;
  }
  study::writeReport(options.out);
  fmt::print("wrote {}\n", (fs::path(options.out) / "index.html").string());
  if (!whole) {
    fmt::print(stderr, "interrupted; the same command goes on from here\n");
    throw truth::Interrupted();
  }
  if (options.check) messages.throwIfAny();
}

}  // namespace

void addMeasure(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "measure", "Measure what settings cost and how far they are from the truth");
  command->add_option("--scene", options->scene, "A .gltf or .glb file; default: the atrium")
      ->type_name("FILE");
  command->add_option("--camera", options->cameras, "Camera files; errors are averaged over them")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--path", options->path,
                   "A camera path: JSON with cameras, and frames from the first to the last; adds "
                   "the flicker along it")
      ->type_name("FILE");
  command->add_option("--sweep", options->sweeps, "A parameter and its values; several make a grid")
      ->type_name("EFFECT.PARAMETER=VALUE,...")
      ->allow_extra_args(false);
  command->add_option("--set", options->sets, "A parameter's value in all settings")
      ->type_name("EFFECT.PARAMETER=VALUE")
      ->allow_extra_args(false);
  command->add_option("--effects", options->effects, "Effects that run besides the swept ones")
      ->delimiter(',');
  command->add_option("--output", options->output,
                      "What is compared with the truth; default: the first effect's visibility");
  command->add_option("--radius", options->radius, "Length of the truth's rays, metres")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  command->add_option("--samples", options->samples, "The truth's rays a pixel")
      ->check(CLI::Range(16u, 65536u))
      ->capture_default_str();
  command->add_option("--size", options->size, "Pixels")->type_name("WxH")->capture_default_str();
  command->add_option("--rounds", options->rounds, "How often each setting's cost is measured")
      ->check(CLI::Range(1u, 1000u))
      ->capture_default_str();
  command->add_option("--backend", options->backend, "opengl, vulkan or both")
      ->capture_default_str();
  command->add_option("--device", options->device, "Number or part of a device's name");
  command
      ->add_option("--shard", options->shard,
                   "Part I of N of the settings; parts of one study may share --out")
      ->type_name("I/N");
  command->add_option("--plugin-path", options->pluginPaths, "A further folder of effects")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->add_option("--out", options->out, "The study's folder; what it holds is not done again")
      ->type_name("DIR")
      ->required();
  command->add_flag("--report", options->reportOnly,
                    "Measure nothing: write the report of what --out holds");
  command->add_flag("--check", options->check,
                    "Validate every call, in the layer and in the driver");
  command->callback([options] { measure(*options); });
}

}  // namespace grisaille::app
