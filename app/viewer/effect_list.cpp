// SPDX-License-Identifier: MIT
#include "app/viewer/effect_list.h"

#include <algorithm>
#include <utility>

#include "app/settings/presets.h"
#include "core/base/error.h"

namespace grisaille::app::viewer {

EffectList::EffectList(const effect::Registry& registry) : registry_(&registry) {
  for (const effect::Effect& effect : registry.effects()) {
    entries_.push_back({.on = false, .values = effect::Values(effect)});
  }
}

EffectList::Entry* EffectList::find(std::string_view key) {
  const auto found = std::ranges::find_if(entries_, [&](const Entry& e) { return key == e.key(); });
  return found == entries_.end() ? nullptr : &*found;
}

void EffectList::move(size_t from, size_t to) {
  if (from >= entries_.size() || to >= entries_.size()) return;
  const auto at = [&](size_t index) { return entries_.begin() + static_cast<ptrdiff_t>(index); };
  if (from < to) {
    std::rotate(at(from), at(from + 1), at(to + 1));
  } else {
    std::rotate(at(to), at(from), at(from + 1));
  }
}

EffectList::State EffectList::state() const {
  State state;
  for (const Entry& entry : entries_) {
    State::One& one = state.effects.emplace_back();
    one.key = entry.key();
    one.on = entry.on;
    for (const grisaille_param_desc& param : entry.values.effect().params()) {
      one.values.emplace_back(param.key, entry.values.text(param.key));
    }
  }
  return state;
}

std::vector<std::string> EffectList::restore(const State& state) {
  std::vector<std::string> dropped;
  size_t placed = 0;  // so many are where they belong
  for (const State::One& one : state.effects) {
    const Entry* found = find(one.key);
    const auto index = found == nullptr ? 0 : static_cast<size_t>(found - entries_.data());
    if (found == nullptr || index < placed) {
      dropped.push_back(fmt::format("effect {} is {}", oneLine(one.key),
                                    found == nullptr ? "not there" : "named twice"));
      continue;
    }
    move(index, placed);
    Entry& entry = entries_[placed++];
    entry.on = one.on;
    entry.values = effect::Values(entry.values.effect());
    for (const auto& [key, text] : one.values) {
      try {
        entry.values.set(key, text);
      } catch (const Error& error) {
        dropped.push_back(error.detail());
      }
    }
  }
  for (size_t i = placed; i < entries_.size(); ++i) entries_[i].on = false;
  return dropped;
}

Settings EffectList::settings() const {
  Settings settings;
  settings.effects.emplace();
  for (const Entry& entry : entries_) {
    if (!entry.on) continue;
    settings.effects->emplace_back(entry.key());
    for (const grisaille_param_desc& param : entry.values.effect().params()) {
      settings.values.push_back({.effect = entry.key(),
                                 .key = param.key,
                                 .text = entry.values.text(param.key),
                                 .place = {}});
    }
  }
  return settings;
}

void EffectList::apply(const Settings& settings, const std::vector<std::string>& presets) {
  const std::vector<std::string>& keys = settings.effects ? *settings.effects : kDefaultEffects;
  ActiveEffects active(*registry_, keys);
  applyPresets(presets, active);
  applySettings(settings, active);
  std::vector<Entry> entries;
  for (const std::string& key : keys) {
    entries.push_back({.on = true, .values = active.values(key)});
  }
  for (const Entry& entry : entries_) {
    if (std::ranges::find(keys, entry.key()) == keys.end()) {
      entries.push_back({.on = false, .values = entry.values});
    }
  }
  entries_ = std::move(entries);
}

EffectList EffectList::rebound(const EffectList& old, const effect::Registry& fresh,
                               std::vector<std::string>& dropped) {
  EffectList list(fresh);
  const std::vector<std::string> lines = list.restore(old.state());
  dropped.insert(dropped.end(), lines.begin(), lines.end());
  return list;
}

}  // namespace grisaille::app::viewer
