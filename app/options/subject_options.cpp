// SPDX-License-Identifier: MIT
#include "app/options/subject_options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/options/camera_option.h"
#include "app/options/option_checks.h"
#include "app/options/size.h"
#include "app/settings/settings.h"
#include "app/truth/content_hash.h"
#include "app/truth/occlusion_truth.h"
#include "core/base/error.h"
#include "core/base/quote.h"
#include "core/shots/shot_file.h"
#include "core/trace/paint_mask.h"

namespace grisaille::app {
namespace {

namespace fs = std::filesystem;

bool hasOneChannel(const grisaille_output_desc& output) {
  return output.format == GRISAILLE_FORMAT_R8 || output.format == GRISAILLE_FORMAT_R16F ||
         output.format == GRISAILLE_FORMAT_R32F;
}

// With paint, the first output of one channel of the effect that takes shots; else the first
// visibility.
std::string defaultOutput(const ActiveEffects& active, bool paint) {
  for (const effect::Effect* effect : active.effects()) {
    if (paint && !effect->takesShots()) continue;
    for (const grisaille_output_desc& output : effect->outputs()) {
      if (paint ? hasOneChannel(output) : output.role == GRISAILLE_ROLE_VISIBILITY) {
        return std::string(effect->desc->key) + "." + output.key;
      }
    }
  }
  throw Error(ErrorId::kUsage, "no effect has {}; name an --output",
              paint ? "paint of one channel" : "a visibility");
}

}  // namespace

void SubjectOptions::addTo(CLI::App& command) {
  command
      .add_option("--camera", cameras,
                  "Camera files, or their JSON itself; errors are averaged over them")
      ->type_name("FILE|{...}")
      ->allow_extra_args(false);
  command.add_option("--set", sets, "A parameter's value in all settings")
      ->type_name("EFFECT.PARAMETER=VALUE")
      ->allow_extra_args(false);
  command.add_option("--effects", effects, "Effects that run, in order; default: ssao")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--output", output,
                     "What is compared with the truth; default: the first visibility");
  command
      .add_option("--paint", paint,
                  "Shots with ranges: the truth is the mask of what their muzzles see")
      ->type_name("FILE");
  command.add_option("--radius", radius, "Length of the truth's rays, metres")
      ->check(numberFrom(1e-6, 1e6))
      ->capture_default_str();
  command.add_option("--samples", samples, "The truth's rays a pixel")
      ->check(wholeNumberFrom(16, 65536))
      ->capture_default_str();
  command.add_option("--size", size, "Pixels")->type_name("WxH")->capture_default_str();
  command.add_option("--plugin-path", pluginPaths, "A further folder of effects")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

LoadedSubject::LoadedSubject(const SubjectOptions& options,
                             std::unique_ptr<effect::Registry> registry,
                             const std::vector<std::string>& swept)
    : options_(options), registry_(std::move(registry)) {
  subject_.effects = options.effects;
  for (const std::string& effect : swept) {
    if (std::ranges::find(subject_.effects, effect) == subject_.effects.end()) {
      subject_.effects.push_back(effect);
    }
  }
  if (subject_.effects.empty()) subject_.effects = kDefaultEffects;
  ActiveEffects active(*registry_, subject_.effects);
  for (const std::string& set : options.sets) active.set(set);
  const bool paint = !options.paint.empty();
  subject_.output = options.output.empty() ? defaultOutput(active, paint) : options.output;
  frame::checkOutput(subject_.output, active.effects());
  subject_.size = parseSize(options.size);
  subject_.registry = registry_.get();
  subject_.sets = options.sets;
  subject_.scene = &scene_;
  if (paint) loadShots(active);
  for (const std::string& text : options.cameras) {
    cameras_.emplace_back(isInlineCamera(text) ? "camera " + std::to_string(cameras_.size() + 1)
                                               : fs::path(text).stem().string(),
                          cameraOf(text, "--camera"));
  }
}

void LoadedSubject::loadShots(const ActiveEffects& active) {
  std::vector<grisaille_shot> shots = shots::load(options_.paint);
  for (size_t i = 0; i < shots.size(); ++i) {
    if (shots[i].range > 0) continue;
    throw Error(ErrorId::kUsage, "shot {} of {} has no range of its own", i, options_.paint);
  }
  for (const effect::Effect* effect : active.effects()) {
    if (effect->takesShots()) subject_.shots[effect->desc->key] = shots;
  }
  if (subject_.shots.empty()) {
    throw Error(ErrorId::kEffectTakesNoShots, "--paint is given, but no effect that runs paints");
  }
}

void LoadedSubject::loadScene() {
  scene_ = options_.scene.empty() ? scene::makeAtrium() : scene::loadGltf(options_.scene);
  if (!cameras_.empty()) return;
  cameras_.emplace_back("default", options_.scene.empty() ? scene::atriumCamera()
                                                          : scene::overviewCamera(scene_.bounds));
}

study::View LoadedSubject::viewOf(const std::string& name, const scene::Camera& camera,
                                  const std::string& bar) const {
  study::View view{.name = name, .camera = camera, .truth = {}};
  view.camera.size = subject_.size;
  const auto [width, height] = std::pair(subject_.size.x, subject_.size.y);
  std::vector<trace::Hit> hits;
  if (options_.paint.empty()) {
    truth::OcclusionTruth traced =
        truth::traceOcclusion(scene_, view.camera, subject_.size, options_.radius, options_.samples,
                              options_.progress || isatty(STDERR_FILENO) == 1, bar);
    view.truth = std::move(traced.visibility);
    view.noise = traced.error;
    hits = std::move(traced.hits);
  } else {
    const trace::RayTracer tracer(scene_, view.camera.eye);
    hits = tracer.castPrimary(view.camera, width, height);
    const std::vector<uint8_t> mask =
        trace::paintMask(tracer, hits, subject_.shots.begin()->second, 0);
    view.truth = {width, height, 1, std::vector<float>(mask.begin(), mask.end())};
  }
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].viewDepth == 0) view.truth.pixels[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return view;
}

void LoadedSubject::trace() {
  for (const auto& [name, camera] : cameras_) {
    const std::string bar =
        fmt::format("truth {} of {}", subject_.views.size() + 1, cameras_.size());
    subject_.views.push_back(viewOf(name, camera, bar));
  }
}

std::string LoadedSubject::key() const {
  std::string key = fmt::format("scene {:016x}\nsize {}x{}\nradius {}\nsamples {}\noutput {}\n",
                                truth::hashOf(scene_), subject_.size.x, subject_.size.y,
                                options_.radius, options_.samples, subject_.output);
  for (const std::string& set : subject_.sets) key += "set " + set + "\n";
  for (const std::string& effect : subject_.effects) key += "effect " + effect + "\n";
  for (const auto& [effect, shots] : subject_.shots) {
    truth::ContentHash hash;
    hash.add<grisaille_shot>(shots);
    key += fmt::format("shots {} {:016x}\n", effect, hash.value());
  }
  for (const study::View& view : subject_.views) {
    key += "camera " + scene::cameraJson(view.camera) + "\n";
  }
  return key;
}

std::string LoadedSubject::renderCommand(const study::Setting& setting,
                                         const std::string& backend) const {
  std::string command = "grisaille render";
  const auto add = [&](const std::string& word) { command += " " + shellQuoted(word); };
  if (!options_.scene.empty()) add(options_.scene);
  add("--backend"), add(backend), add("--camera"), add(scene::cameraJson(subject_.views[0].camera));
  add("--size"), add(fmt::format("{}x{}", subject_.size.x, subject_.size.y));
  add("--effects"), add(fmt::format("{}", fmt::join(subject_.effects, ",")));
  for (const auto& [effect, shots] : subject_.shots)
    add("--load"), add(effect + "=" + options_.paint);
  for (const std::string& set : subject_.sets) add("--set"), add(set);
  for (const auto& [name, value] : setting) add("--set"), add(name + "=" + value);
  add("--write"), add(subject_.output + "=picture.png");
  return command;
}

}  // namespace grisaille::app
