// SPDX-License-Identifier: MIT
#include "lab/paint/shot.h"

#include <array>

#include "core/objects/object_file.h"

namespace grisaille::lab {
namespace {

using Numbers = std::array<double, 3>;

template <typename T>
void store(const Numbers& numbers, T (&to)[3]) {
  for (size_t i = 0; i < 3; ++i) to[i] = static_cast<T>(numbers[i]);
}

template <typename T>
Numbers numbersOf(const T (&from)[3]) {
  return {double{from[0]}, double{from[1]}, double{from[2]}};
}

}  // namespace

const objects::Table& shotTable(const effect::Registry& registry) {
  const objects::Table* table = registry.find("sspm").objects();
  if (table == nullptr) throw Error(ErrorId::kEffectTakesNoObjects, "sspm has no objects");
  return *table;
}

std::vector<Shot> shotsOf(const objects::View& objects) {
  const auto field = [&](const char* key) { return objects::fieldOf(*objects.table, key); };
  const objects::Field origin = field("origin"), direction = field("direction"),
                       color = field("color"), range = field("range");
  std::vector<Shot> shots(objects.count);
  for (size_t i = 0; i < objects.count; ++i) {
    store(objects.value(i, origin).numbers, shots[i].origin);
    store(objects.value(i, direction).numbers, shots[i].direction);
    store(objects.value(i, color).numbers, shots[i].color);
    shots[i].range = objects.value(i, range).numbers[0];
  }
  return shots;
}

objects::Objects objectsOf(const objects::Table& table, std::span<const Shot> shots) {
  objects::Objects all(table);
  all.reserve(shots.size());
  for (const Shot& shot : shots) {
    objects::Object object(table);
    object.at(table, "origin").numbers = numbersOf(shot.origin);
    object.at(table, "direction").numbers = numbersOf(shot.direction);
    object.at(table, "color").numbers = numbersOf(shot.color);
    object.at(table, "range").numbers = {shot.range, 0, 0};
    all.append(object);
  }
  return all;
}

std::vector<Shot> loadShots(const effect::Registry& registry, const std::string& path) {
  return shotsOf(objects::load(shotTable(registry), path).view());
}

}  // namespace grisaille::lab
