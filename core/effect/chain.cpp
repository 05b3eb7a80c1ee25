// SPDX-License-Identifier: MIT
#include "core/effect/chain.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace grisaille::effect {
namespace {

// For each field of the old table: the index of the same field in the new table, or nullopt.
using Counterparts = std::vector<std::optional<size_t>>;

// Adds a line to `dropped` for each field that is missing or has another type. Returns nullopt if
// the new table requires a field that the old objects do not have.
std::optional<Counterparts> counterpartsOf(const objects::Table& old, const objects::Table& table,
                                           std::vector<std::string>& dropped) {
  const std::span fields = objects::fieldsOf(table);
  Counterparts counterparts;
  std::vector<bool> given(fields.size());
  for (const objects::Field& field : objects::fieldsOf(old)) {
    const auto found = std::ranges::find_if(fields, [&](const objects::Field& other) {
      return std::string_view(field.key) == other.key && field.type == other.type;
    });
    if (found == fields.end()) {
      dropped.push_back(fmt::format("{}.{} is missing or has another type", old.key, field.key));
      counterparts.emplace_back();
    } else {
      counterparts.emplace_back(found - fields.begin());
      given[*counterparts.back()] = true;
    }
  }
  for (size_t i = 0; i < fields.size(); ++i) {
    if (given[i] || (fields[i].flags & GRISAILLE_FIELD_REQUIRED) == 0) continue;
    dropped.push_back(fmt::format("all {}: they have no \"{}\"", old.key, fields[i].key));
    return std::nullopt;
  }
  return counterparts;
}

// Converts `old` to a list of the new table, which may have other fields. New fields get their
// defaults.
objects::ObjectList converted(const objects::ObjectList& old, const objects::Table& table,
                              std::vector<std::string>& dropped) {
  objects::ObjectList list(table);
  if (old.size() == 0) return list;
  const auto counterparts = counterpartsOf(old.table(), table, dropped);
  if (!counterparts) return list;
  objects::Objects kept(table);
  objects::Object to(table);
  for (size_t i = 0; i < old.size(); ++i) {
    const objects::Object from = old.object(i);
    for (size_t f = 0; f < from.values.size(); ++f) {
      if (const auto index = (*counterparts)[f]) to.values[*index] = from.values[f];
    }
    const std::string name = fmt::format("{}[{}]", old.table().key, i);
    try {
      kept.append(to, name);
    } catch (const Error& error) {
      dropped.push_back(error.detail());
    }
  }
  list.assign(kept.view());
  return list;
}

}  // namespace

objects::ObjectList* Chain::objects(std::string_view effect) {
  const Selection::Entry* entry = selection.find(effect);
  if (entry == nullptr || entry->effect().objects() == nullptr) return nullptr;
  const auto found = lists_.find(effect);
  if (found != lists_.end()) return &found->second;
  return &lists_.try_emplace(std::string(effect), *entry->effect().objects()).first->second;
}

uint64_t Chain::objectsRevision() const {
  uint64_t sum = endedRevisions_;
  for (const auto& [effect, list] : lists_) sum += list.revision();
  return sum;
}

void Chain::start(gpu::Maker& device) {
  stop();
  device_ = &device;
}

void Chain::create() {
  for (const Selection::Entry& entry : selection.entries()) {
    if (!entry.on) continue;
    Running& one = running_[entry.key()];
    if (!one.instance) one = {std::make_unique<Instance>(*device_, entry.effect()), 0};
  }
}

void Chain::end() {
  for (auto& [effect, one] : running_) {
    if (one.instance) one.instance->end();
  }
  stop();
}

template <typename Inputs, typename Call>
void Chain::offer(const Selection::Entry& entry, Inputs& inputs, const Call& call) {
  Running& one = running_.find(entry.key())->second;
  const objects::ObjectList* list = objects(entry.key());
  if (list != nullptr) {
    inputs.objects = list->view();
    inputs.objectsKept = list->keptSince(one.seen);
  }
  inputs.values = entry.values.all();
  call(*one.instance);
  if (list != nullptr) one.seen = list->revision();
}

Report Chain::record(const Selection::Entry& entry, FrameInputs inputs) {
  Report report;
  offer(entry, inputs, [&](Instance& instance) {
    instance.record(inputs);
    report = instance.report();
  });
  return report;
}

void Chain::drawAt(const Selection::Entry& entry, PointInputs inputs) {
  create();
  offer(entry, inputs, [&](Instance& instance) { instance.drawAt(inputs); });
}

size_t Chain::resources() const {
  size_t sum = 0;
  for (const auto& [effect, one] : running_) sum += one.instance ? one.instance->resources() : 0;
  return sum;
}

objects::ObjectList* Chain::objectsEvenIfAbsent(std::string_view effect) {
  Absent* absent = findAbsent(effect);
  if (absent == nullptr) return objects(effect);
  return absent->list ? &*absent->list : nullptr;
}

Chain::Absent* Chain::findAbsent(std::string_view effect) {
  const auto found =
      std::ranges::find_if(absent_, [&](const Absent& one) { return one.settings.key == effect; });
  return found == absent_.end() ? nullptr : &*found;
}

Selection::State Chain::state() const {
  Selection::State whole = selection.state();
  for (const Absent& one : absent_) {
    const auto before = std::ranges::find(whole.effects, one.before, &Selection::State::One::key);
    const bool first = one.before.empty() || before == whole.effects.end();
    whole.effects.insert(first ? whole.effects.begin() : before + 1, one.settings);
  }
  return whole;
}

std::vector<std::string> Chain::restore(const Selection::State& state) {
  Selection::State present;
  std::string before;
  for (const Selection::State::One& one : state.effects) {
    if (Absent* absent = findAbsent(one.key)) {
      absent->settings = one;
      absent->before = before;
    } else {
      present.effects.push_back(one);
    }
    before = one.key;
  }
  return selection.restore(present);
}

// Moves a list to another table.
objects::ObjectList Chain::moved(objects::ObjectList list, const objects::Table& table,
                                 std::vector<std::string>& dropped) {
  if (list.adopt(table)) return list;
  endedRevisions_ += list.revision() + 1;
  return converted(list, table, dropped);
}

// Keeps the list of an effect that is absent, or drops one whose effect takes no objects any more.
void Chain::loseList(const std::string& effect, objects::ObjectList list,
                     std::vector<std::string>& dropped) {
  endedRevisions_ += list.revision() + 1;
  if (list.size() > 0) dropped.push_back(fmt::format("{} of {}", list.table().key, effect));
  Absent* absent = findAbsent(effect);
  if (absent == nullptr) return;
  absent->table = std::make_unique<objects::OwnTable>(list.table());
  list.adopt(absent->table->table());
  absent->list = std::move(list);
}

std::vector<std::string> Chain::rebind(const Registry& fresh) {
  stop();
  const Selection::State whole = state();
  Selection chosen(fresh);
  Selection::State present;
  std::vector<std::string> dropped;
  std::vector<Absent> earlier = std::exchange(absent_, {});
  const auto earlierOf = [&](std::string_view key) {
    return std::ranges::find_if(earlier, [&](const Absent& a) { return a.settings.key == key; });
  };
  std::string before;
  for (const Selection::State::One& one : whole.effects) {
    const auto was = earlierOf(one.key);
    if (chosen.find(one.key) != nullptr) {
      present.effects.push_back(one);
    } else {
      if (was == earlier.end()) dropped.push_back(fmt::format("effect {} is unknown", one.key));
      absent_.push_back(was != earlier.end() ? std::move(*was)
                                             : Absent{.settings = one, .before = {}});
      absent_.back().before = before;
    }
    before = one.key;
  }
  const std::vector<std::string> unfit = chosen.restore(present);
  dropped.insert(dropped.end(), unfit.begin(), unfit.end());

  std::map<std::string, objects::ObjectList, std::less<>> lists;
  const auto take = [&](const std::string& effect, objects::ObjectList& list) {
    const Selection::Entry* entry = chosen.find(effect);
    if (entry == nullptr || entry->effect().objects() == nullptr) {
      loseList(effect, std::move(list), dropped);
    } else {
      lists.emplace(effect, moved(std::move(list), *entry->effect().objects(), dropped));
    }
  };
  for (auto& [effect, list] : lists_) take(effect, list);
  for (Absent& back : earlier) {
    if (back.list && findAbsent(back.settings.key) == nullptr) take(back.settings.key, *back.list);
  }
  selection = std::move(chosen);
  lists_ = std::move(lists);
  return dropped;
}

uint32_t guardBand(const Values& values, uint32_t height) {
  return static_cast<uint32_t>(std::ceil(values.effect().guardBand(values.all().data()) * height));
}

}  // namespace grisaille::effect
