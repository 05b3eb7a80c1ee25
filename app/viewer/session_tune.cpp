// SPDX-License-Identifier: MIT
// The session's presets, and the commands and results of `grisaille tune`.
#include <algorithm>

#include "app/viewer/session.h"

namespace grisaille::app::viewer {

void Session::loadAllPresets() {
  presets_.clear();
  for (const effect::Effect& effect : registry_->effects()) {
    EffectPresets& own = presets_[effect.desc->key];
    try {
      own.presets = loadPresets(effect);
    } catch (const Error& error) {
      own.error = error.what();
    }
  }
}

const EffectPresets& Session::presetsOf(const std::string& effect) const {
  static const EffectPresets kNone;
  const auto found = presets_.find(effect);
  return found == presets_.end() ? kNone : found->second;
}

void Session::choosePreset(effect::Selection::Entry& entry, const std::string& name) {
  noteChanges();
  applyPreset(entry.values, presetsOf(entry.key()).presets, name);
  changed(std::string(entry.key()) + ", preset " + name);
}

std::string Session::outputToTune(const std::string& effect) const {
  const auto belongs = [&](const std::string& output) { return output.starts_with(effect + "."); };
  if (belongs(comparedOutput())) return comparedOutput();
  const std::vector<std::string> outputs = comparable();
  const auto found = std::ranges::find_if(outputs, belongs);
  return found == outputs.end() ? "" : *found;
}

bool Session::staysInTune(std::string_view parameter) const {
  return parameter == "radius" && !comparing.radius;
}

TuneCommand Session::tuneCommand(const TuneWish& wish, glm::uvec2 view, const std::string& backend,
                                 const std::string& device) {
  const effect::Selection::Entry* entry = chain.selection.find(wish.effect);
  TuneCommand command;
  command.output = outputToTune(wish.effect);
  if (entry == nullptr || command.output.empty()) {
    throw Error(ErrorId::kUsage, "effect '{}' has no visibility output to tune", wish.effect);
  }
  command.scene = scenePath;
  command.pose = poseArguments(playback.pose);
  command.camera = camera;
  command.camera.size = glm::uvec2(0);
  command.size = tuneSize(view);
  command.backend = backend;
  command.device = device;
  command.effects = &chain.selection;
  command.radius = truthRadius(command.output);
  command.samples = comparing.rays;
  (wish.byBudget ? command.budget : command.maxError) = wish.byBudget ? wish.budget : wish.maxError;
  command.evaluations = wish.evaluations;
  command.pluginPaths = options_.pluginPaths;
  const Presets& presets = presetsOf(wish.effect).presets;
  for (const grisaille_param_desc* param : tunable(entry->effect(), presets)) {
    if (staysInTune(param->key) || wish.stay.contains(param->key)) continue;
    command.vary.push_back({.effect = wish.effect, .key = param->key});
  }
  if (command.vary.empty())
    throw Error(ErrorId::kUsage, "no parameter is ticked under 'May change'");
  return command;
}

void Session::takeTuned(const std::string& effect,
                        const std::vector<effect::ParameterValue>& values) {
  effect::Selection::Entry* entry = chain.selection.find(effect);
  if (entry == nullptr) throw Error(ErrorId::kUsage, "effect '{}' no longer exists", effect);
  effect::Values found = entry->values;
  for (const effect::ParameterValue& one : values) found.set(one.name.key, one.value);
  noteChanges();
  entry->values = found;
  changed(effect + ", tuned");
  noteChanges();
}

}  // namespace grisaille::app::viewer
