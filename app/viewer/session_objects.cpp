// SPDX-License-Identifier: MIT
// The session's objects: lists of objects that users place, as the effects' tables describe them.
#include <fmt/format.h>

#include <algorithm>
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
  choose(effect, listOf(effect).size() - 1);
  return true;
}

std::vector<glm::dvec3> Session::pointsOf(const objects::ObjectList& list, size_t first,
                                          size_t count) {
  const objects::Table& table = list.table();
  const auto numbers = [&](size_t index, uint32_t field) {
    const auto of = list.view().value(index, table.fields[field]).numbers;
    return glm::dvec3(of[0], of[1], of[2]);
  };
  std::vector<glm::dvec3> points;
  std::vector<grisaille_ray> rays;
  for (size_t i = first; i < first + count; ++i) {
    const glm::dvec3 point = numbers(i, table.point_field);
    points.push_back(point);
    if (table.placement != GRISAILLE_PLACE_RAY || !services) continue;
    const glm::vec3 unit(glm::normalize(numbers(i, table.direction_field)));
    rays.push_back({.origin = {point.x, point.y, point.z},
                    .direction = {unit.x, unit.y, unit.z},
                    .reach = std::numeric_limits<float>::infinity()});
  }
  std::vector<grisaille_hit> hits(rays.size());
  if (!rays.empty()) attempt("selection", [&] { services->rays().cast(rays, hits); });
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].kind != GRISAILLE_HIT_SURFACE) continue;
    const auto& direction = rays[i].direction;
    points[i] += double{hits[i].distance} * glm::dvec3(direction[0], direction[1], direction[2]);
  }
  return points;
}

std::optional<Session::Chosen> Session::chosen() {
  if (!chosen_) return std::nullopt;
  const objects::ObjectList* list = chain.objects(chosen_->effect);
  return list != nullptr && chosen_->index < list->size() ? chosen_ : std::nullopt;
}

std::optional<glm::dvec3> Session::chosenPoint() {
  const auto now = chosen();
  if (!now) return std::nullopt;
  return pointsOf(listOf(now->effect), now->index, 1).front();
}

void Session::chooseNear(const glm::dvec3& at, double reach) {
  chosen_.reset();
  double nearest = reach;
  for (const std::string& effect : effectsWithObjects()) {
    const std::vector<glm::dvec3> points = pointsOf(listOf(effect), 0, listOf(effect).size());
    for (size_t i = 0; i < points.size(); ++i) {
      const double distance = glm::length(points[i] - at);
      if (distance > nearest) continue;  // of several in one place, the one on top
      nearest = distance;
      chosen_ = Chosen{effect, i};
    }
  }
}

void Session::deleteChosen() {
  const auto now = chosen();
  if (!now) return;
  changeObjects(now->effect, "delete", false,
                [&](objects::ObjectList& list) { list.remove(now->index); });
}

void Session::reorderChosen(size_t index) {
  const auto now = chosen();
  if (!now) return;
  index = std::min(index, listOf(now->effect).size() - 1);
  changeObjects(now->effect, "order", false,
                [&](objects::ObjectList& list) { list.move(now->index, index); });
  choose(now->effect, index);
}

bool Session::moveChosen(glm::dvec2 point, glm::uvec2 size, bool joins) {
  const auto now = chosen();
  if (!now) return false;
  const objects::ObjectList& list = listOf(now->effect);
  const auto moved =
      placedAt(point, size, camera, services->rays(), list.table(), list.object(now->index));
  if (!moved) return false;
  changeObjects(now->effect, fmt::format("{}[{}], move", list.table().key, now->index), joins,
                [&](objects::ObjectList& own) { own.set(now->index, *moved); });
  return true;
}

void Session::clearObjects(const std::string& effect) {
  changeObjects(effect, "clear", false, [](objects::ObjectList& list) { list.clear(); });
}

void Session::loadObjects(const std::string& effect, const std::string& path) {
  objects::Objects loaded = objects::load(listOf(effect).table(), path);
  const size_t count = loaded.size();
  changeObjects(effect, "load", false,
                [&](objects::ObjectList& list) { list.replace(std::move(loaded)); });
  say(fmt::format("{} {} from {}", count, listOf(effect).table().key, path));
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
