// SPDX-License-Identifier: MIT
#include "app/options/subject_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>

#include "app/options/camera_option.h"
#include "app/options/object_options.h"
#include "app/options/option_checks.h"
#include "app/options/size.h"
#include "app/services/scene_lengths.h"
#include "app/settings/chosen_effects.h"
#include "app/study/sweep.h"
#include "app/truth/content_hash.h"
#include "app/truth/occlusion_truth.h"
#include "core/base/error.h"
#include "core/base/quote.h"
#include "core/objects/object_file.h"

namespace grisaille::app {
namespace {

namespace fs = std::filesystem;

std::string defaultOutput(const effect::Selection& selection) {
  for (const effect::Effect* effect : selection.effects()) {
    for (const grisaille_output_desc& output : effect->outputs()) {
      if (output.role != GRISAILLE_ROLE_VISIBILITY) continue;
      return std::string(effect->key()) + "." + output.key;
    }
  }
  throw Error(ErrorId::kUsage, "no effect has a visibility output; give --output");
}

// The values that differ from their defaults.
std::vector<effect::Assignment> changesOf(const effect::Selection& selection) {
  std::vector<effect::Assignment> all;
  for (const effect::Selection::Entry& entry : selection.entries()) {
    const effect::Values defaults(entry.effect());
    for (const grisaille_param_desc& param : entry.effect().params()) {
      std::string text = entry.values.text(param.key);
      if (text == defaults.text(param.key)) continue;
      all.push_back({.name = {.effect = entry.key(), .key = param.key}, .value = std::move(text)});
    }
  }
  return all;
}

// Sets the truth to NaN at pixels that see no surface.
void onSurfacesAlone(study::View& view, std::span<const trace::Hit> hits) {
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].viewDepth == 0) view.truth.pixels[i] = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace

void SubjectOptions::addTo(CLI::App& command) {
  command
      .add_option("--camera", cameras,
                  "A camera file or its JSON; errors are averaged over all --camera")
      ->type_name("FILE|{...}")
      ->allow_extra_args(false);
  pose.addTo(command);
  command.add_option("--set", sets, "Value of a parameter in all settings")
      ->type_name("EFFECT.PARAMETER=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--effects", effects,
                  "Effects, in the order they run; default: those that `grisaille effects` marks")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--output", output,
                     "Output that is compared with the truth; default: the first visibility");
  command
      .add_option("--reference", references,
                  "A picture to use as the truth, one per --camera, in the same order; default: "
                  "trace the visibility")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      .add_option("--load", loads,
                  "Load objects of an effect from a file that `grisaille render --save` wrote")
      ->type_name("EFFECT=FILE.json")
      ->allow_extra_args(false);
  command
      .add_option("--radius", radius,
                  "Length of the truth's rays, metres; default: chosen for the scene")
      ->check(numberFrom(1e-6, 1e6));
  command.add_option("--samples", samples, "Number of the truth's rays per pixel")
      ->check(wholeNumberFrom(16, 65536))
      ->capture_default_str();
  command.add_option("--size", size, "Size in pixels")->type_name("WxH")->capture_default_str();
  command.add_option("--plugin-path", pluginPaths, "Another folder to load effects from")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

LoadedSubject::LoadedSubject(const SubjectOptions& options,
                             std::shared_ptr<const effect::Registry> registry,
                             const std::vector<effect::ParameterName>& swept)
    : options_(options), swept_(swept), registry_(std::move(registry)) {
  effect::Chain chain = chooseEffects();
  subject_.output = options.output.empty() ? defaultOutput(chain.selection) : options.output;
  frame::checkOutput(subject_.output, chain.selection.effects());
  subject_.size = parseSize(options.size);
  subject_.registry = registry_.get();
  subject_.scene = &scene_;
  loadObjects(chain);
  for (const std::string& text : options.cameras) {
    cameras_.push_back({isInlineCamera(text) ? "camera " + std::to_string(cameras_.size() + 1)
                                             : fs::path(text).stem().string(),
                        cameraOf(text, "--camera"), ""});
  }
  if (options.references.empty()) return;
  if (cameras_.empty()) cameras_.push_back({"default", {}, ""});
  if (options.references.size() != cameras_.size()) {
    throw Error(ErrorId::kUsage, "{} --reference for {} cameras; give one for each camera",
                options.references.size(), cameras_.size());
  }
  for (size_t i = 0; i < cameras_.size(); ++i) cameras_[i].reference = options.references[i];
}

// Fills in the subject's effects and sets.
effect::Chain LoadedSubject::chooseEffects() {
  const Settings settings = options_.config.empty() ? Settings{} : readSettings(options_.config);
  subject_.effects = options_.effects;
  if (subject_.effects.empty() && settings.effects) subject_.effects = *settings.effects;
  for (const effect::ParameterName& one : swept_) {
    if (std::ranges::find(subject_.effects, one.effect) == subject_.effects.end()) {
      subject_.effects.push_back(one.effect);
    }
  }
  if (subject_.effects.empty()) subject_.effects = registry_->defaults();
  effect::Chain chain(chosenEffects(*registry_, subject_.effects, options_.presets, settings));
  subject_.sets = changesOf(chain.selection);
  for (const std::string& set : options_.sets) {
    subject_.sets.push_back(effect::parseAssignment(set));
    chain.selection.set(subject_.sets.back());
  }
  return chain;
}

void LoadedSubject::loadObjects(effect::Chain& chain) {
  const ObjectOptions objects{.loads = options_.loads, .adds = {}, .saves = {}};
  objects.check(chain);
  objects.load(chain);
  for (const auto& [effect, list] : chain.objectLists()) {
    subject_.objects.emplace(effect, list.table()).first->second.append(list.view());
  }
}

void LoadedSubject::loadScene() {
  scene_ = scene::loadScene(options_.scene);
  pose_ = options_.pose.poseOf(scene_);
  // Lengths are chosen for the scene at rest, as in SceneView.
  chooseLengths();
  if (options_.cameras.empty()) {
    if (cameras_.empty()) cameras_.push_back({"default", {}, ""});
    cameras_[0].camera = defaultCamera(scene_, pose_, aspectOf(subject_.size));
  }
  if (pose_.animation) scene::pose(scene_, pose_);
}

void LoadedSubject::chooseLengths() {
  const double radius = suitableRadius(scene_);
  effect::Selection selection(*registry_, subject_.effects);
  fitLengths(selection, radius);
  for (const effect::Assignment& set : subject_.sets) selection.set(set);
  for (const effect::ParameterName& one : swept_) {
    effect::Values& values = selection.values(one.effect);
    values.set(one.key, values.get(one.key));
  }
  subject_.lengths = lengthsOf(selection);
  const bool given = options_.radius != 0;
  if (!given) options_.radius = radius;
  printChosen(selection, given ? std::optional<double>() : radius,
              options_.name.empty() ? "the scene" : options_.name);
}

study::View LoadedSubject::viewOf(const std::string& name, const scene::Camera& camera,
                                  const std::string& bar) const {
  study::View view{.scene = options_.name, .name = name, .camera = camera, .truth = {}};
  view.camera.size = subject_.size;
  truth::OcclusionTruth traced =
      truth::traceOcclusion(scene_, view.camera, subject_.size, options_.radius, options_.samples,
                            options_.progress, bar);
  view.truth = std::move(traced.visibility);
  view.noise = traced.error;
  onSurfacesAlone(view, traced.hits);
  return view;
}

study::View LoadedSubject::referenceOf(const Place& place) const {
  study::View view{.scene = options_.name, .name = place.name, .camera = place.camera, .truth = {}};
  view.camera.size = subject_.size;
  view.truth = study::oneChannel(image::read(place.reference), place.reference);
  if (view.truth.width != subject_.size.x || view.truth.height != subject_.size.y) {
    throw Error(ErrorId::kImageMismatch, "{} has {}x{} pixels, not {}x{}", place.reference,
                view.truth.width, view.truth.height, subject_.size.x, subject_.size.y);
  }
  const trace::RayTracer tracer(scene_, view.camera.eye);
  onSurfacesAlone(view, tracer.castPrimary(view.camera, subject_.size.x, subject_.size.y));
  return view;
}

void LoadedSubject::trace() {
  for (const Place& place : cameras_) {
    const std::string bar =
        fmt::format("{}truth {} of {}", options_.name.empty() ? "" : options_.name + ": ",
                    subject_.views.size() + 1, cameras_.size());
    subject_.views.push_back(place.reference.empty() ? viewOf(place.name, place.camera, bar)
                                                     : referenceOf(place));
  }
}

std::string LoadedSubject::key() const {
  std::string key = fmt::format("scene {:016x}\nsize {}x{}\nradius {}\nsamples {}\noutput {}\n",
                                truth::hashOf(scene_), subject_.size.x, subject_.size.y,
                                options_.radius, options_.samples, subject_.output);
  for (const effect::Assignment& length : study::textOf(*registry_, subject_.lengths)) {
    key += "length " + length.text() + "\n";
  }
  for (const effect::Assignment& set : subject_.sets) key += "set " + set.text() + "\n";
  for (const std::string& effect : subject_.effects) key += "effect " + effect + "\n";
  for (const auto& [effect, objects] : subject_.objects) {
    truth::ContentHash hash;
    hash.add(objects::jsonOf(objects.view()));
    key += fmt::format("objects {} {:016x}\n", effect, hash.value());
  }
  for (size_t i = 0; i < cameras_.size(); ++i) {
    if (cameras_[i].reference.empty()) continue;
    truth::ContentHash hash;
    hash.add(std::span<const float>(subject_.views[i].truth.pixels));
    key += fmt::format("reference {:016x}\n", hash.value());
  }
  for (const study::View& view : subject_.views) {
    key += "camera " + scene::cameraJson(view.camera) + "\n";
  }
  return key;
}

std::string LoadedSubject::renderCommand(const study::SettingText& setting,
                                         const std::string& backend) const {
  std::string command = "grisaille render";
  const auto add = [&](const std::string& word) { command += " " + shellQuoted(word); };
  if (!options_.scene.empty()) add(options_.scene);
  for (const std::string& word : poseArguments(pose_)) add(word);
  add("--backend"), add(backend), add("--camera"), add(scene::cameraJson(subject_.views[0].camera));
  add("--size"), add(fmt::format("{}x{}", subject_.size.x, subject_.size.y));
  add("--effects"), add(fmt::format("{}", fmt::join(subject_.effects, ",")));
  for (const std::string& load : options_.loads) add("--load"), add(load);
  for (const effect::Assignment& length : study::textOf(*registry_, subject_.lengths)) {
    add("--set"), add(length.text());
  }
  for (const effect::Assignment& set : subject_.sets) add("--set"), add(set.text());
  for (const effect::Assignment& one : setting) add("--set"), add(one.text());
  add("--write"), add(subject_.output + "=picture.png");
  return command;
}

}  // namespace grisaille::app
