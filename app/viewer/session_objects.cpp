// SPDX-License-Identifier: MIT
// The session's objects: lists of objects that users place, as the effects' tables describe them.
#include <fmt/format.h>

#include <limits>
#include <span>

#include "app/services/placement.h"
#include "app/viewer/session.h"
#include "core/objects/object_file.h"

namespace grisaille::app::viewer {

std::vector<std::string> Session::effectsWithObjects() const {
  std::vector<std::string> keys;
  for (const effect::Selection::Entry& entry : chain.selection.entries()) {
    if (entry.on && entry.effect().objects() != nullptr) keys.emplace_back(entry.key());
  }
  return keys;
}

std::string Session::placer() const {
  const std::vector<std::string> keys = effectsWithObjects();
  if (keys.empty()) return "";
  return std::ranges::find(keys, placer_) == keys.end() ? keys.front() : placer_;
}

void Session::placeWith(const std::string& effect, bool on) {
  placer_ = effect;
  placing = on;
}

objects::Object& Session::nextObject(const std::string& effect) {
  const objects::Table& table = listOf(effect).table();
  const auto found = next_.find(effect);
  if (found != next_.end()) return found->second;
  return next_.emplace(effect, objects::Object(table)).first->second;
}

objects::ObjectList& Session::listOf(const std::string& effect) {
  objects::ObjectList* list = effect.empty() ? nullptr : chain.objects(effect);
  if (list != nullptr) return *list;
  throw Error(ErrorId::kEffectTakesNoObjects, "no effect that is on has objects");
}

void Session::changeObjects(const std::string& effect, const std::string& what, bool joins,
                            const std::function<void(objects::ObjectList&)>& change) {
  objects::ObjectList& list = listOf(effect);
  const uint64_t before = list.revision();
  change(list);
  if (list.revision() == before) return;
  noteChanges();
  history.noteObjects(effect, 1, what, joins);
}

bool Session::sprays() {
  const std::string effect = placer();
  return !effect.empty() && listOf(effect).table().placement == GRISAILLE_PLACE_RAY;
}

bool Session::place(glm::dvec2 point, glm::uvec2 size, bool joins) {
  const std::string effect = placer();
  const objects::Table& table = listOf(effect).table();
  const auto object = placedAt(point, size, camera, services->rays(), table, nextObject(effect));
  if (!object) return false;
  changeObjects(effect, fmt::format("{}, {}", table.key, joins ? "spray" : "one"), joins,
                [&](objects::ObjectList& list) { list.add(*object); });
  return true;
}

glm::dvec3 Session::pointOf(const objects::ObjectList& list, size_t index) {
  const objects::Table& table = list.table();
  const auto numbers = [&](uint32_t field) {
    const auto of = list.view().value(index, table.fields[field]).numbers;
    return glm::dvec3(of[0], of[1], of[2]);
  };
  const glm::dvec3 point = numbers(table.point_field);
  if (table.placement != GRISAILLE_PLACE_RAY || !services) return point;
  const glm::vec3 unit(glm::normalize(numbers(table.direction_field)));
  const grisaille_ray ray = {.origin = {point.x, point.y, point.z},
                             .direction = {unit.x, unit.y, unit.z},
                             .reach = std::numeric_limits<float>::infinity()};
  grisaille_hit hit = {};
  attempt("selection", [&] { services->rays().cast(std::span(&ray, 1), std::span(&hit, 1)); });
  const bool meets = hit.kind == GRISAILLE_HIT_SURFACE;
  return meets ? point + double{hit.distance} * glm::dvec3(unit) : point;
}

void Session::clearObjects(const std::string& effect) {
  changeObjects(effect, "clear", false, [](objects::ObjectList& list) { list.clear(); });
}

void Session::loadObjects(const std::string& effect, const std::string& path) {
  const objects::Objects loaded = objects::load(listOf(effect).table(), path);
  changeObjects(effect, "load", false,
                [&](objects::ObjectList& list) { list.replace(loaded.view()); });
  say(fmt::format("{} {} from {}", loaded.size(), loaded.table().key, path));
}

void Session::saveObjects(const std::string& effect, const std::string& path) {
  const objects::View all = listOf(effect).view();
  objects::save(all, path);
  say(fmt::format("{} {} to {}", all.count, all.table->key, path));
}

std::string Session::ownerOf(const std::string& path) {
  const std::string list = objects::listKeyOf(path);
  for (const std::string& effect : effectsWithObjects()) {
    if (listOf(effect).table().key == list) return effect;
  }
  return "";
}

}  // namespace grisaille::app::viewer
