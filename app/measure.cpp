// SPDX-License-Identifier: MIT
// grisaille measure: measures the cost and the error of settings.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/command.h"
#include "app/options/driver_messages.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/scene_options.h"
#include "app/options/start_device.h"
#include "app/options/subject_options.h"
#include "app/report/machine.h"
#include "app/settings/load_effects.h"
#include "app/study/choose.h"
#include "app/study/flicker_run.h"
#include "app/study/gallery.h"
#include "app/study/report.h"
#include "app/study/study.h"
#include "app/truth/interruption.h"
#include "app/truth/progress.h"
#include "backends/backends.h"
#include "core/base/atomic_file.h"

namespace grisaille::app {
namespace {

namespace fs = std::filesystem;

struct MeasureOptions {
  SubjectOptions subject;
  std::string backend = "both", device, out, shard = "1/1", presets, path, gallery, scenes, grids;
  std::vector<std::string> also;
  std::vector<std::string> sweeps;
  uint32_t rounds = 5;
  bool check = false, reportOnly = false;
};

// The parsed command line, checked before any slow work starts.
struct MeasureJob {
  std::vector<std::unique_ptr<LoadedSubject>> subjects;  // one per scene
  std::vector<study::Setting> settings;
  std::vector<std::string> backendNames;
  std::vector<scene::Camera> path;             // for the flicker; empty: flicker is not measured
  std::vector<trace::FlickerFrame> pathTruth;  // one per camera of the path

  explicit MeasureJob(const MeasureOptions& options);

  // Everything that results depend on except setting and backend.
  std::string key() const;
};

// The options of each scene: those of the command line, or of the gallery.
std::vector<SubjectOptions> scenesOf(const MeasureOptions& options) {
  if (options.gallery.empty()) return {options.subject};
  std::vector<SubjectOptions> all;
  for (study::GalleryScene& scene : study::loadGallery(options.gallery, options.scenes)) {
    SubjectOptions& own = all.emplace_back(options.subject);
    own.name = scene.name;
    own.scene = std::move(scene.scene);
    own.cameras = std::move(scene.cameras);
    own.radius = scene.radius;
    own.sets.insert(own.sets.begin(), scene.sets.begin(), scene.sets.end());
  }
  return all;
}

MeasureJob::MeasureJob(const MeasureOptions& options) {
  const std::shared_ptr<const effect::Registry> registry = loadEffects(options.subject.pluginPaths);
  std::vector<study::Sweep> sweeps;
  for (const std::string& text : options.sweeps) {
    sweeps.push_back(study::parseSweep(*registry, text));
  }
  const study::Shard shard = study::parseShard(options.shard);
  const std::vector<study::Setting> grid =
      options.grids.empty() ? study::gridOf(sweeps) : study::loadGrids(*registry, options.grids);
  std::vector<effect::ParameterName> swept;
  for (const study::Setting& setting : grid) {
    for (const effect::ParameterValue& one : setting) {
      if (std::ranges::find(swept, one.name) == swept.end()) swept.push_back(one.name);
    }
  }
  for (size_t i = 0; i < grid.size(); ++i) {
    if (shard.holds(i)) settings.push_back(grid[i]);
  }
  backendNames = chosenBackends(options.backend);
  for (const SubjectOptions& scene : scenesOf(options)) {
    subjects.push_back(std::make_unique<LoadedSubject>(scene, registry, swept));
  }
  if (options.path.empty()) return;
  path = scene::camerasOf(scene::loadCameraPath(options.path));
  study::checkPathSize(options.path, path.size(), subjects.front()->subject().size);
}

std::string MeasureJob::key() const {
  std::string key;
  for (const auto& subject : subjects) key += subject->key();
  for (const scene::Camera& camera : path) key += "path " + scene::cameraJson(camera) + "\n";
  return key;
}

void tracePath(const MeasureOptions& options, MeasureJob& job) {
  const study::Subject& subject = job.subjects.front()->subject();
  for (const scene::Camera& camera : job.path) {
    job.pathTruth.push_back(study::traceFrame(*subject.scene, camera, subject.size,
                                              job.subjects.front()->radius(),
                                              options.subject.samples, truth::usualProgress()));
  }
}

// Returns false if a signal interrupted the study.
bool measureOn(const std::string& backend, const MeasureOptions& options, const MeasureJob& job,
               const study::StudyDesc& desc, DriverMessages& messages) {
  const auto device = backends::create(backend, {.device = options.device,
                                                 .check = options.check,
                                                 .timed = true,
                                                 .message = messages.sink()});
  printDevice(device->info());
  truth::Progress progress(backend, truth::usualProgress());
  study::Study study(desc, *device, job.settings);
  return study.run(
      [&](size_t done, size_t all) {
        progress.show({static_cast<double>(done), static_cast<double>(all),
                       fmt::format("{} of {}", done, all)});
      },
      truth::Interruption::asked);
}

// Compares the files of the report with that of --presets.
void requireDistinctOutputs(const MeasureOptions& options) {
  std::vector<NamedOutput> outputs = {{"--presets " + options.presets, options.presets}};
  for (const char* name : study::kReportFiles) {
    const std::string file = fs::path(options.out) / name;
    outputs.push_back({fmt::format("--out {} (its {})", options.out, name), file});
  }
  requireDistinct(outputs);
}

std::vector<study::NamedPreset> namedPresets(const MeasureOptions& options) {
  if (!options.also.empty() && options.presets.empty()) {
    throw Error(ErrorId::kUsage, "--also names presets, but --presets with their file is missing");
  }
  std::vector<study::NamedPreset> named;
  for (const std::string& text : options.also) named.push_back(study::parseNamedPreset(text));
  return named;
}

void report(const MeasureOptions& options) {
  study::writeReport(options.out);
  fmt::print("wrote {}\n", (fs::path(options.out) / "index.html").string());
  if (options.presets.empty()) return;
  study::writePresets(study::loadAll(options.out), namedPresets(options), options.presets);
  fmt::print("wrote {}\n", options.presets);
}

void measure(const MeasureOptions& options) {
  requireDistinctOutputs(options);
  namedPresets(options);  // mistakes in it show before anything is measured
  if (options.reportOnly) return report(options);
  MeasureJob job(options);
  requireDevices(job.backendNames, options.device);
  requireWritableFolder(options.out);
  if (!options.presets.empty()) requireWritable(options.presets);
  for (const auto& subject : job.subjects) subject->loadScene();
  const truth::Interruption interruption;
  std::vector<const study::Subject*> subjects;
  for (const auto& subject : job.subjects) {
    subject->trace();
    subjects.push_back(&subject->subject());
  }
  tracePath(options, job);
  const study::StudyDesc desc{.subjects = subjects,
                              .path = job.path.empty() ? nullptr : &job.pathTruth,
                              .key = job.key(),
                              .machine = machineName(),
                              .commit = GRISAILLE_COMMIT,
                              .rounds = options.rounds,
                              .folder = options.out,
                              .commandOf = [&](const auto& setting, const std::string& backend) {
                                return job.subjects.front()->renderCommand(setting, backend);
                              }};
  std::error_code failed;
  fs::create_directories(options.out, failed);  // for the report, if nothing is measured
  DriverMessages messages;
  bool whole = true;
  for (const std::string& name : job.backendNames) {
    whole = measureOn(name, options, job, desc, messages);
    if (!whole) break;
  }
  report(options);
  if (!whole) {
    fmt::print(stderr, "note: interrupted; run the same command again to continue\n");
    throw truth::Interrupted();
  }
  if (options.check) messages.throwIfAny();
}

void addGallery(CLI::App& command, MeasureOptions& options) {
  CLI::Option* gallery =
      command
          .add_option("--gallery", options.gallery,
                      "Measure the scenes of this file, each with its cameras and radius; errors "
                      "and costs are averaged over all scenes")
          ->type_name("FILE.toml");
  for (const char* other : {"scene", "--camera", "--radius", "--reference", "--load", "--path",
                            "--animation", "--time"}) {
    gallery->excludes(command.get_option(other));
  }
  command
      .add_option("--scenes", options.scenes,
                  "Folder of scenes that do not stand beside the gallery file")
      ->type_name("DIR")
      ->needs(gallery);
}

}  // namespace

void addMeasure(CLI::App& program) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* command = program.add_subcommand(
      "measure", "Measure the cost of settings and their error against ray-traced truth");
  command->add_option("scene", options->subject.scene, sceneHelp());
  command
      ->add_option("--sweep", options->sweeps,
                   "A parameter and the values to measure; several --sweep span a grid")
      ->type_name("EFFECT.PARAMETER=VALUE,...")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--grids", options->grids,
          "Settings to measure side by side, instead of --sweep: each line of the file has "
          "sweeps that span a grid of their own")
      ->type_name("FILE")
      ->excludes("--sweep");
  options->subject.addTo(*command);
  command->add_option("--rounds", options->rounds, "Number of times that each cost is measured")
      ->check(wholeNumberFrom(1, 1000))
      ->capture_default_str();
  command->add_option("--backend", options->backend, "opengl, vulkan or both")
      ->capture_default_str();
  command->add_option("--device", options->device,
                      "Number of a device or part of its name, see `grisaille backends`");
  command
      ->add_option("--path", options->path,
                   "A camera path; adds the error and the flicker along it. JSON with \"cameras\" "
                   "and \"frames\", the number of frames from the first camera to the last")
      ->type_name("FILE");
  command
      ->add_option("--shard", options->shard,
                   "Measure part I of N of the settings; all parts may share one --out")
      ->type_name("I/N");
  command
      ->add_option("--out", options->out,
                   "Folder of the study; measurements that it holds are not repeated")
      ->type_name("DIR")
      ->required();
  command->add_flag("--report", options->reportOnly,
                    "Only write the report of the measurements in --out");
  command
      ->add_option("--presets", options->presets,
                   "Choose presets of the swept effect from the front, and write them")
      ->type_name("FILE.toml");
  command
      ->add_option("--also", options->also,
                   "With --presets: also the preset NAME, of the settings with this value the one "
                   "with the least error")
      ->type_name("NAME=EFFECT.KEY=VALUE");
  command->add_flag("--check", options->check,
                    "Validate every graphics call, in the rendering layer and in the driver");
  addGallery(*command, *options);
  command->callback([options] { measure(*options); });
}

}  // namespace grisaille::app
