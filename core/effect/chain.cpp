// SPDX-License-Identifier: MIT
#include "core/effect/chain.h"

#include <cmath>
#include <utility>

namespace grisaille::effect {
namespace {

// What `old` holds, in a list of the new table, whose fields may be others.
objects::ObjectList converted(const objects::ObjectList& old, const objects::Table& table,
                              std::vector<std::string>& dropped) {
  objects::ObjectList list(table);
  objects::Objects kept(table);
  const std::span before = objects::fieldsOf(old.table());
  for (size_t i = 0; i < old.size(); ++i) {
    const objects::Object from = old.object(i);
    objects::Object to(table);
    try {
      for (size_t f = 0; f < before.size(); ++f) to.at(table, before[f].key) = from.values[f];
      kept.append(to);
    } catch (const Error& error) {
      dropped.push_back(fmt::format("{}[{}]: {}", old.table().key, i, error.detail()));
    }
  }
  list.assign(kept.view());
  return list;
}

}  // namespace

objects::ObjectList* Chain::objects(std::string_view effect) {
  const auto found = lists_.find(effect);
  if (found != lists_.end()) return &found->second;
  const Selection::Entry* entry = selection.find(effect);
  if (entry == nullptr || entry->effect().objects() == nullptr) return nullptr;
  return &lists_.try_emplace(std::string(effect), *entry->effect().objects()).first->second;
}

uint64_t Chain::objectsRevision() const {
  uint64_t sum = 0;
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

uint64_t Chain::record(const Selection::Entry& entry, FrameInputs inputs) {
  Running& one = running_.find(entry.key())->second;
  const objects::ObjectList* list = objects(entry.key());
  if (list != nullptr) {
    inputs.objects = list->view();
    inputs.objectsKept = list->keptSince(one.seen);
  }
  inputs.values = entry.values.all();
  one.instance->record(inputs);
  if (list != nullptr) one.seen = list->revision();
  return one.instance->waiting();
}

std::vector<std::string> Chain::rebind(const Registry& fresh) {
  stop();
  Selection chosen(fresh);
  std::vector<std::string> dropped = chosen.restore(selection.state());
  std::map<std::string, objects::ObjectList, std::less<>> lists;
  for (auto& [effect, list] : lists_) {
    const Selection::Entry* entry = chosen.find(effect);
    if (entry == nullptr || entry->effect().objects() == nullptr) {
      if (list.size() > 0) dropped.push_back(fmt::format("{} of {}", list.table().key, effect));
      continue;
    }
    const objects::Table& table = *entry->effect().objects();
    lists.emplace(effect, list.adopt(table) ? std::move(list) : converted(list, table, dropped));
  }
  selection = std::move(chosen);
  lists_ = std::move(lists);
  return dropped;
}

uint32_t guardBand(const Values& values, uint32_t height) {
  return static_cast<uint32_t>(std::ceil(values.effect().guardBand(values.all().data()) * height));
}

}  // namespace grisaille::effect
