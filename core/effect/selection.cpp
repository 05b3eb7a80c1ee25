// SPDX-License-Identifier: MIT
#include "core/effect/selection.h"

#include <algorithm>

#include "core/base/error.h"

namespace grisaille::effect {

bool followsScene(const Values& values, const grisaille_param_desc& param) {
  return (param.flags & GRISAILLE_PARAM_SCENE_LENGTH) != 0 && !values.given(param.key);
}

Selection::Selection(const Registry& registry) : registry_(&registry) {
  for (const Effect& effect : registry.effects()) {
    entries_.push_back({.on = false, .values = Values(effect)});
  }
}

Selection::Selection(const Registry& registry, std::span<const std::string> keys)
    : registry_(&registry) {
  for (const std::string& key : keys) {
    if (std::ranges::count(keys, key) > 1) {
      throw Error(ErrorId::kEffectTwice, "effect '{}' is named twice", key);
    }
    entries_.push_back({.on = true, .values = Values(registry.find(key))});
  }
}

Selection::Entry* Selection::find(std::string_view key) {
  return const_cast<Entry*>(std::as_const(*this).find(key));
}

const Selection::Entry* Selection::find(std::string_view key) const {
  const auto found = std::ranges::find_if(entries_, [&](const Entry& e) { return key == e.key(); });
  return found == entries_.end() ? nullptr : &*found;
}

Values& Selection::values(std::string_view key) {
  Entry* entry = find(key);
  if (entry != nullptr && entry->on) return entry->values;
  if (registry_ != nullptr) registry_->find(key);  // the likelier mistake: report it first
  throw Error(ErrorId::kEffectUnknown, "effect '{}' is set but not among the active effects",
              oneLine(key));
}

std::vector<const Effect*> Selection::effects() const {
  std::vector<const Effect*> all;
  for (const Entry& entry : entries_) {
    if (entry.on) all.push_back(&entry.effect());
  }
  return all;
}

void Selection::move(size_t from, size_t to) {
  if (from >= entries_.size() || to >= entries_.size()) return;
  const auto at = [&](size_t index) { return entries_.begin() + static_cast<ptrdiff_t>(index); };
  if (from < to) {
    std::rotate(at(from), at(from + 1), at(to + 1));
  } else {
    std::rotate(at(to), at(from), at(from + 1));
  }
}

Selection::State Selection::state() const {
  State state;
  for (const Entry& entry : entries_) {
    State::One& one = state.effects.emplace_back();
    one.key = entry.key();
    one.on = entry.on;
    for (const grisaille_param_desc& param : entry.effect().params()) {
      if (followsScene(entry.values, param)) continue;
      one.values.emplace_back(param.key, entry.values.text(param.key));
    }
  }
  return state;
}

std::vector<std::string> Selection::restore(const State& state) {
  std::vector<std::string> dropped;
  size_t placed = 0;  // number of entries already in place
  for (const State::One& one : state.effects) {
    const Entry* found = find(one.key);
    const auto index = found == nullptr ? 0 : static_cast<size_t>(found - entries_.data());
    if (found == nullptr || index < placed) {
      dropped.push_back(fmt::format("effect {} is {}", oneLine(one.key),
                                    found == nullptr ? "unknown" : "named twice"));
      continue;
    }
    move(index, placed);
    Entry& entry = entries_[placed++];
    entry.on = one.on;
    entry.values.reset();
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

}  // namespace grisaille::effect
