// SPDX-License-Identifier: MIT
// grisaille measure: measures the cost and the error of settings.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/command.h"
#include "app/options/driver_messages.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/start_device.h"
#include "app/options/subject_options.h"
#include "app/report/machine.h"
#include "app/settings/load_effects.h"
#include "app/study/choose.h"
#include "app/study/flicker_run.h"
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
  std::string backend = "both", device, out, shard = "1/1", presets, path;
  std::vector<std::string> also;
  std::vector<std::string> sweeps;
  uint32_t rounds = 5;
  bool check = false, reportOnly = false;
};

// The parsed command line, checked before any slow work starts.
struct MeasureJob {
  std::unique_ptr<LoadedSubject> subject;
  std::vector<study::Setting> settings;
  std::vector<std::string> backendNames;
  std::vector<scene::Camera> path;             // for the flicker; empty: flicker is not measured
  std::vector<trace::FlickerFrame> pathTruth;  // one per camera of the path

  explicit MeasureJob(const MeasureOptions& options);
};

MeasureJob::MeasureJob(const MeasureOptions& options) {
  auto registry = loadEffects(options.subject.pluginPaths);
  std::vector<study::Sweep> sweeps;
  std::vector<effect::ParameterName> swept;
  for (const std::string& text : options.sweeps) {
    sweeps.push_back(study::parseSweep(*registry, text));
    swept.push_back(sweeps.back().name);
  }
  const study::Shard shard = study::parseShard(options.shard);
  const std::vector<study::Setting> grid = study::gridOf(sweeps);
  for (size_t i = 0; i < grid.size(); ++i) {
    if (shard.holds(i)) settings.push_back(grid[i]);
  }
  backendNames = chosenBackends(options.backend);
  subject = std::make_unique<LoadedSubject>(options.subject, std::move(registry), swept);
  if (options.path.empty()) return;
  path = scene::camerasOf(scene::loadCameraPath(options.path));
  study::checkPathSize(options.path, path.size(), subject->subject().size);
}

// Traces the truth of the path. Returns the path's part of the study's key.
std::string tracePath(const MeasureOptions& options, MeasureJob& job) {
  std::string key;
  const study::Subject& subject = job.subject->subject();
  for (const scene::Camera& camera : job.path) {
    key += "path " + scene::cameraJson(camera) + "\n";
    job.pathTruth.push_back(study::traceFrame(*subject.scene, camera, subject.size,
                                              job.subject->radius(), options.subject.samples,
                                              truth::usualProgress()));
  }
  return key;
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
  job.subject->loadScene();
  const truth::Interruption interruption;
  job.subject->trace();
  const std::string pathKey = tracePath(options, job);
  const study::StudyDesc desc{.subject = job.subject->subject(),
                              .path = job.path.empty() ? nullptr : &job.pathTruth,
                              .key = job.subject->key() + pathKey,
                              .machine = machineName(),
                              .commit = GRISAILLE_COMMIT,
                              .rounds = options.rounds,
                              .folder = options.out,
                              .commandOf = [&](const auto& setting, const std::string& backend) {
                                return job.subject->renderCommand(setting, backend);
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

}  // namespace

void addMeasure(CLI::App& program) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* command = program.add_subcommand(
      "measure", "Measure the cost of settings and their error against ray-traced truth");
  command->add_option("scene", options->subject.scene,
                      "A .gltf or .glb file; default: the built-in atrium");
  command
      ->add_option("--sweep", options->sweeps,
                   "A parameter and the values to measure; several --sweep span a grid")
      ->type_name("EFFECT.PARAMETER=VALUE,...")
      ->allow_extra_args(false);
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
  command->callback([options] { measure(*options); });
}

}  // namespace grisaille::app
