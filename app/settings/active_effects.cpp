// SPDX-License-Identifier: MIT
#include "app/settings/active_effects.h"

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"

namespace grisaille::app {

std::unique_ptr<effect::Registry> loadEffects(const std::vector<std::string>& pluginPaths) {
  auto registry = std::make_unique<effect::Registry>();
  for (const effect::SearchPath& path : effect::searchPaths(pluginPaths)) {
    if (path.required || std::filesystem::is_directory(path.folder)) {
      registry->scan(path.folder, path.origin);
    }
  }
  return registry;
}

ActiveEffects::ActiveEffects(const effect::Registry& registry, const std::vector<std::string>& keys)
    : registry_(registry) {
  for (const std::string& key : keys) {
    if (std::count(keys.begin(), keys.end(), key) > 1) {
      throw Error(ErrorId::kEffectTwice, "effect '{}' is named twice", key);
    }
    values_.push_back(std::make_unique<effect::Values>(registry.find(key)));
  }
}

effect::Values& ActiveEffects::values(std::string_view key) {
  for (const auto& values : values_) {
    if (values->effect().desc->key == key) return *values;
  }
  registry_.find(key);  // an unknown effect is the likelier mistake: say so first
  throw Error(ErrorId::kEffectUnknown, "effect '{}' is set but not among the active effects", key);
}

void ActiveEffects::set(const std::string& assignment) {
  const size_t dot = assignment.find('.');
  const size_t equals = assignment.find('=');
  if (dot == std::string::npos || equals == std::string::npos || equals < dot) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form EFFECT.PARAMETER=VALUE", assignment);
  }
  values(assignment.substr(0, dot))
      .set(assignment.substr(dot + 1, equals - dot - 1), assignment.substr(equals + 1));
}

std::vector<const effect::Effect*> ActiveEffects::effects() const {
  std::vector<const effect::Effect*> all;
  for (const auto& values : values_) all.push_back(&values->effect());
  return all;
}

std::vector<std::unique_ptr<effect::Instance>> ActiveEffects::start(gpu::Device& device) const {
  std::vector<std::unique_ptr<effect::Instance>> instances;
  for (const auto& values : values_) {
    instances.push_back(std::make_unique<effect::Instance>(device, values->effect()));
  }
  return instances;
}

std::vector<frame::ActiveEffect> ActiveEffects::with(
    const std::vector<std::unique_ptr<effect::Instance>>& instances) const {
  std::vector<frame::ActiveEffect> all;
  for (size_t i = 0; i < instances.size(); ++i) {
    all.push_back({.instance = instances[i].get(), .values = values_[i].get()});
  }
  return all;
}

}  // namespace grisaille::app
