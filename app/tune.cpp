// SPDX-License-Identifier: MIT
// grisaille tune: finds the cheapest setting within an error, or the best setting within a budget.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/options/camera_option.h"
#include "app/options/driver_messages.h"
#include "app/options/option_checks.h"
#include "app/options/scene_options.h"
#include "app/options/subject_options.h"
#include "app/settings/load_effects.h"
#include "app/settings/presets.h"
#include "app/settings/settings.h"
#include "app/study/random_cameras.h"
#include "app/study/tuning.h"
#include "app/truth/interruption.h"
#include "app/truth/progress.h"
#include "backends/backends.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"

namespace grisaille::app {
namespace {

struct TuneOptions {
  SubjectOptions subject;
  std::vector<std::string> vary, validate;
  std::string backend = "opengl", device, out;
  double maxError = 0, budget = 0;
  uint32_t random = 3, seed = 1, evaluations = 80;
  bool json = false;
};

// The parameters that may change: those of --vary, else those that a preset of the effect names and
// all that are not advanced, without those of look.
std::vector<study::Axis> axesOf(const TuneOptions& options, const study::Subject& subject) {
  std::vector<study::Axis> axes;
  const auto add = [&](const effect::Effect& effect, const grisaille_param_desc& param) {
    axes.push_back({{.effect = effect.desc->key, .key = param.key}, &param});
  };
  for (const std::string& text : options.vary) {
    const effect::ParameterName name = effect::parseParameterName(text);
    const effect::Effect& effect = subject.registry->find(name.effect);
    add(effect, effect.params()[effect::Values(effect).indexOf(name.key)]);
  }
  if (!options.vary.empty()) return axes;
  for (const std::string& key : subject.effects) {
    const effect::Effect& effect = subject.registry->find(key);
    for (const grisaille_param_desc* param : tunable(effect, loadPresets(effect)))
      add(effect, *param);
  }
  return axes;
}

// The cameras of --validate.
std::vector<scene::Camera> givenCameras(const TuneOptions& options) {
  std::vector<scene::Camera> cameras;
  for (const std::string& text : options.validate) {
    cameras.push_back(cameraOf(text, "--validate"));
  }
  return cameras;
}

struct NamedCamera {
  std::string name;
  scene::Camera camera;
};

// The cameras that the search does not use: those of --validate, else random ones.
std::vector<NamedCamera> unseenCameras(const TuneOptions& options,
                                       const std::vector<scene::Camera>& given,
                                       const LoadedSubject& subject) {
  std::vector<NamedCamera> all;
  for (size_t i = 0; i < given.size(); ++i) all.push_back({options.validate[i], given[i]});
  if (!given.empty() || options.random == 0) return all;
  const double radius = subject.radius();
  for (const scene::Camera& camera :
       study::randomCameras(*subject.subject().scene, {.like = subject.firstCamera(),
                                                      .radius = radius,
                                                      .count = options.random,
                                                      .seed = options.seed})) {
    all.push_back({fmt::format("random {}", all.size() + 1), camera});
  }
  if (all.empty()) {
    throw Error(ErrorId::kNothingToSee,
                "no random camera sees occluders within --radius {} m on a third of its pixels",
                radius);
  }
  if (all.size() < options.random) {
    fmt::print(stderr,
               "warning: only {} of {} random cameras see occluders within --radius {} m on a "
               "third of their pixels\n",
               all.size(), options.random, radius);
  }
  return all;
}

// Throws kNothingToSee if every setting is right, because no camera sees an occluded surface.
void requireOcclusion(const TuneOptions& options, const LoadedSubject& subject) {
  if (!options.subject.references.empty()) return;
  for (const study::View& view : subject.subject().views) {
    if (study::occludedShare(view.truth) > 0) return;
  }
  throw Error(ErrorId::kNothingToSee, "no --camera sees an occluder within --radius {} m",
              subject.radius());
}

std::string wishText(const study::Wish& wish) {
  return wish.maxError > 0 ? fmt::format("RMSE {} or less", wish.maxError)
                           : fmt::format("{} ms or less", wish.budget);
}

// Number of settings that a grid of the search's smallest steps would have.
double gridSize(const std::vector<study::Axis>& axes) {
  double all = 1;
  for (const study::Axis& axis : axes) {
    const bool few =
        axis.param->type == GRISAILLE_PARAM_ENUM || axis.param->type == GRISAILLE_PARAM_BOOL;
    constexpr double kValues = 33;
    double values = few ? axis.param->hard_max + 1 : kValues;
    if (axis.param->type == GRISAILLE_PARAM_INT) {
      values = std::min(values, axis.param->soft_max - axis.param->soft_min + 1);
    }
    all *= values;
  }
  return all;
}

study::Found find(const TuneOptions& options, const LoadedSubject& subject,
                  const std::vector<study::Axis>& axes, const study::Wish& wish,
                  study::Bench& bench) {
  const auto starts = study::startsOf(subject.subject(), axes);
  truth::Progress progress("tune", options.subject.progress);
  double done = 0;
  const auto told = [&](double error) {
    progress.show({++done, static_cast<double>(options.evaluations),
                   fmt::format("{:.0f} evaluations, RMSE {:.4f}", done, error)});
  };
  const study::Oracle oracle{
      .error =
          [&](const study::Point& point) {
            const double error = bench.error(point);
            told(error);
            return error;
          },
      .cost = [&](const study::Point& point) { return bench.cost(point); },
      .costBeside = [&](const study::Point& point,
                        const study::Evaluated& known) { return bench.costBeside(point, known); },
      .stop = truth::Interruption::asked};
  return study::search(axes, starts, wish, oracle, options.evaluations);
}

// Writes the setting as a settings file. `story`: comment lines that say how it was found.
void writeSetting(const TuneOptions& options, const LoadedSubject& subject,
                  const study::Setting& setting, const std::string& story) {
  Settings settings{.effects = subject.subject().effects, .surface = {}, .values = {}};
  study::SettingText all = study::textOf(subject.registry(), subject.subject().lengths);
  const std::vector<effect::Assignment>& sets = subject.subject().sets;
  all.insert(all.end(), sets.begin(), sets.end());
  const study::SettingText tuned = study::textOf(subject.registry(), setting);
  all.insert(all.end(), tuned.begin(), tuned.end());
  for (const effect::Assignment& one : all) settings.values.push_back({one.name, one.value, ""});
  writeFileAtomically(options.out, story + settingsToml(settings));
}

// The result of a search.
struct Tuned {
  study::Found found;
  study::Setting setting;
  std::vector<study::CameraErrors> unseen;  // errors of cameras that the search did not use
  std::vector<scene::Camera> cameras;       // the cameras of `unseen`
  std::string result, start, effort;        // one line each

  // Mean RMSE of the unseen cameras; 0 if there are none.
  double unseenRmse() const {
    double sum = 0;
    for (const study::CameraErrors& one : unseen) sum += one.rmse;
    return unseen.empty() ? 0 : sum / static_cast<double>(unseen.size());
  }
  // A sentence if the unseen cameras' RMSE is above --max-error or, with a budget, above that of
  // the tuned cameras; else "".
  std::string warning(const study::Wish& wish) const {
    const double promised = wish.maxError > 0 ? wish.maxError : found.best.error;
    if (unseenRmse() <= promised) return "";
    return fmt::format(
        "the RMSE on unseen cameras is {:.4f} above {:.4f}; tune on cameras like them",
        unseenRmse() - promised, promised);
  }
};

void validate(const std::vector<NamedCamera>& cameras, const LoadedSubject& subject,
              gpu::Device& device, Tuned& tuned) {
  if (cameras.empty()) return;
  study::Subject unseen = subject.subject();
  unseen.views.clear();
  for (const auto& [name, camera] : cameras) {
    const std::string bar =
        fmt::format("unseen truth {} of {}", unseen.views.size() + 1, cameras.size());
    unseen.views.push_back(subject.viewOf(name, camera, bar));
  }
  study::Measurer measurer(unseen, device);
  tuned.unseen = measurer.errors(*measurer.start(tuned.setting));
  for (const study::View& view : unseen.views) tuned.cameras.push_back(view.camera);
}

void describe(const LoadedSubject& subject, const std::vector<study::Axis>& axes,
              const gpu::DeviceInfo& info, Tuned& tuned) {
  const study::Found& found = tuned.found;
  const study::Subject& of = subject.subject();
  tuned.result = fmt::format("RMSE {:.4f} at {:.3f} ms ({} clock), {}x{} pixels, {} cameras",
                             found.best.error, found.best.cost, gpu::clockName(info.clock),
                             of.size.x, of.size.y, of.views.size());
  tuned.start =
      fmt::format("started from RMSE {:.4f} at {:.3f} ms", found.first.error, found.first.cost);
  tuned.effort = fmt::format(
      "{} evaluations: {} starts, {} steps (for {} of them the cost was not needed); a grid of the "
      "same steps over {} parameters has {:.2g} settings",
      found.starts + found.steps, found.starts, found.steps, found.costsSaved, axes.size(),
      gridSize(axes));
}

// Prints one JSON object on one line.
void printJson(const Tuned& tuned, const study::Wish& wish) {
  nlohmann::json setting = nlohmann::json::object();
  for (const effect::ParameterValue& one : tuned.setting) setting[one.name.text()] = one.value;
  const nlohmann::json line = {
      {"setting", setting},
      {"rmse", tuned.found.best.error},
      {"milliseconds", tuned.found.best.cost},
      {"start_rmse", tuned.found.first.error},
      {"start_milliseconds", tuned.found.first.cost},
      {"evaluations", tuned.found.starts + tuned.found.steps},
      {"unseen_rmse", tuned.unseen.empty() ? nlohmann::json() : nlohmann::json(tuned.unseenRmse())},
      {"warning", tuned.unseen.empty() ? "" : tuned.warning(wish)}};
  fmt::print("{}\n", line.dump());
}

void printText(const LoadedSubject& subject, const Tuned& tuned, const study::Wish& wish) {
  fmt::print("{}\n  {}\n{}\n{}\n", tuned.result,
             study::nameOf(study::textOf(subject.registry(), tuned.setting)), tuned.start,
             tuned.effort);
  for (size_t i = 0; i < tuned.unseen.size(); ++i) {
    fmt::print("  {}: RMSE {:.4f}  {}\n", tuned.unseen[i].camera, tuned.unseen[i].rmse,
               scene::cameraJson(tuned.cameras[i]));
  }
  if (tuned.unseen.empty()) return;
  fmt::print("on unseen cameras: RMSE {:.4f}\n", tuned.unseenRmse());
  const std::string warning = tuned.warning(wish);
  if (!warning.empty()) fmt::print(stderr, "warning: {}\n", warning);
}

void tune(const TuneOptions& options) {
  const study::Wish wish{options.maxError, options.budget};
  LoadedSubject subject(options.subject, loadEffects(options.subject.pluginPaths), {});
  const std::vector<study::Axis> axes = axesOf(options, subject.subject());
  if (axes.empty()) throw Error(ErrorId::kUsage, "the effects have no parameter to vary");
  const std::vector<scene::Camera> given = givenCameras(options);
  if (!options.out.empty()) requireWritable(options.out);
  // Starts the device first: a device that cannot start must fail before the slow tracing.
  DriverMessages messages;
  const auto device = backends::create(
      options.backend, {.device = options.device, .timed = true, .message = messages.sink()});
  subject.loadScene();
  const truth::Interruption interruption;
  const std::vector<NamedCamera> unseen = unseenCameras(options, given, subject);
  subject.trace();
  requireOcclusion(options, subject);
  const gpu::DeviceInfo& info = device->info();
  if (!options.json) printDevice(info);
  study::Bench bench(subject.subject(), axes, *device);
  Tuned tuned;
  tuned.found = find(options, subject, axes, wish, bench);
  const study::Evaluated& best = tuned.found.best;
  if (tuned.found.stopped) throw truth::Interrupted();
  if (!tuned.found.meetsWish) {
    throw Error(ErrorId::kTuneImpossible, "no setting with {}; nearest: RMSE {:.4f} at {:.3f} ms",
                wishText(wish), best.error, best.cost);
  }
  tuned.setting = bench.settingOf(best.point);
  describe(subject, axes, info, tuned);
  validate(unseen, subject, *device, tuned);
  if (options.json) {
    printJson(tuned, wish);
  } else {
    printText(subject, tuned, wish);
  }
  if (options.out.empty()) return;
  std::string story = fmt::format("# grisaille tune: {}; {}\n# {}: {}\n", wishText(wish),
                                  tuned.result, info.backend, info.name);
  if (!tuned.unseen.empty()) {
    story += fmt::format("# on unseen cameras: RMSE {:.4f}\n", tuned.unseenRmse());
  }
  writeSetting(options, subject, tuned.setting, story);
  if (!options.json) fmt::print("wrote {}\n", options.out);
}

void checkOptions(TuneOptions& options) {
  if (options.json) options.subject.progress = truth::ProgressStyle::kJson;
  if (options.out.empty() && !options.json) {
    throw Error(ErrorId::kUsage, "--out is missing; give it, or --json to print the result");
  }
  if ((options.maxError > 0) == (options.budget > 0)) {
    throw Error(ErrorId::kUsage, "give exactly one of --max-error and --budget-ms");
  }
}

// The setting that the search starts from.
void addStart(CLI::App& command, SubjectOptions& subject) {
  command.get_option("--set")->description(
      "Value of a parameter that the search starts from, see `grisaille effects`");
  command
      .add_option("--preset", subject.presets,
                  "Preset that the search starts from; --config and --set override it")
      ->type_name("EFFECT=NAME")
      ->allow_extra_args(false);
  command
      .add_option("--config", subject.config,
                  "Settings file that the search starts from; --effects and --set override it")
      ->type_name("FILE.toml");
}

}  // namespace

void addTune(CLI::App& program) {
  auto options = std::make_shared<TuneOptions>();
  CLI::App* command = program.add_subcommand(
      "tune", "Find the cheapest setting within an error, or the best setting within a budget");
  command->add_option("scene", options->subject.scene, sceneHelp());
  command
      ->add_option("--max-error", options->maxError,
                   "Find the cheapest setting with at most this RMSE against the truth")
      ->check(positiveNumber());
  command
      ->add_option("--budget-ms", options->budget,
                   "Find the most accurate setting with effects that take at most this time, "
                   "milliseconds")
      ->check(positiveNumber());
  options->subject.addTo(*command);
  addStart(*command, options->subject);
  command
      ->add_option("--vary", options->vary,
                   "Parameters that the search may change; default: those of the presets and all "
                   "that are neither advanced nor of look")
      ->type_name("EFFECT.PARAMETER,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--validate", options->validate,
                   "Cameras to check the result on; the search does not use them")
      ->type_name("FILE|{...}")
      ->allow_extra_args(false);
  command
      ->add_option("--random", options->random,
                   "Number of random cameras inside the scene to check the result on, if "
                   "--validate is not given")
      ->check(wholeNumberFrom(0, 64))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of the random cameras")->capture_default_str();
  command->add_option("--evaluations", options->evaluations, "Largest number of settings to try")
      ->check(wholeNumberFrom(1, 100000))
      ->capture_default_str();
  command->add_option("--backend", options->backend, "opengl or vulkan")->capture_default_str();
  command->add_option("--device", options->device,
                      "Number of a device or part of its name, see `grisaille backends`");
  command->add_option("--out", options->out, "Settings file to write; optional with --json")
      ->type_name("FILE.toml");
  command->add_flag("--json", options->json,
                    "Print progress and result as JSON, one object per line");
  command->callback([options] {
    checkOptions(*options);
    tune(*options);
  });
}

}  // namespace grisaille::app
