// SPDX-License-Identifier: MIT
// Random steps on a list, compared with a model that stores every state.
#include "core/objects/object_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "tests/core/objects/random_objects.h"
#include "tests/support/expect_error.h"

namespace grisaille::objects {
namespace {

using State = std::vector<Object>;

// Copies a list's objects.
State stateOf(const View& view) {
  State state;
  for (size_t i = 0; i < view.count; ++i) state.push_back(view.object(i));
  return state;
}

Objects objectsOf(const State& state, const Table& table) {
  Objects objects(table);
  for (const Object& object : state) objects.append(object);
  return objects;
}

// Stores every state of the list.
struct Model {
  std::vector<State> states = {{}};  // the states that undo and redo step through
  size_t now = 0;
  std::vector<State> revisions = {{}};

  const State& state() const { return states[now]; }
  void change(State state) {
    states.resize(now + 1);
    states.push_back(std::move(state));
    ++now;
    revisions.push_back(states[now]);
  }
  void walk(size_t to) {
    now = to;
    revisions.push_back(states[now]);
  }
  void assign(State state) {
    const bool changes = state != states[now];
    states = {std::move(state)};
    now = 0;
    if (changes) revisions.push_back(states[0]);
  }
  // Largest valid result of keptSince(): the common beginning of all lists since `revision`.
  size_t keptSince(size_t revision) const {
    size_t kept = revisions[revision].size();
    for (size_t r = revision + 1; r < revisions.size(); ++r) {
      const State& later = revisions[r];
      const auto differ = std::mismatch(later.begin(), later.end(), revisions[revision].begin(),
                                        revisions[revision].end());
      kept = std::min(kept, static_cast<size_t>(differ.first - later.begin()));
    }
    return kept;
  }
};

struct Both {
  const Table& table;
  ObjectList list{table};
  Model model;
  std::mt19937_64 random;

  explicit Both(const Table& t, uint64_t seed) : table(t), random(seed) {}

  void add(const Objects& added) {
    State longer = model.state();
    for (const Object& object : stateOf(added.view())) longer.push_back(object);
    if (added.size() > 0) model.change(longer);
    if (random() % 2 == 0) return list.add(Objects(added));
    list.add(added.view());
  }
  void set(const Object& object) {
    if (model.state().empty()) return;
    const size_t index = random() % model.state().size();
    State changed = model.state();
    changed[index] = object;
    if (changed != model.state()) model.change(changed);
    list.set(index, object);
  }
  void remove() {
    if (model.state().empty()) return;
    const size_t index = random() % model.state().size();
    State shorter = model.state();
    shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(index));
    model.change(shorter);
    list.remove(index);
  }
  void move() {
    const size_t from = random() % 6, to = random() % 6, size = model.state().size();
    if (from < size && to < size && from != to) {
      State moved = model.state();
      const Object object = moved[from];
      moved.erase(moved.begin() + static_cast<std::ptrdiff_t>(from));
      moved.insert(moved.begin() + static_cast<std::ptrdiff_t>(to), object);
      model.change(moved);
    }
    list.move(from, to);
  }
  // Assigns objects that often begin like the current list.
  void assign(const Objects& added) {
    State state = model.state();
    state.resize(std::min<size_t>(state.size(), random() % 8), Object(table));
    for (const Object& object : stateOf(added.view())) state.push_back(object);
    model.assign(state);
    if (random() % 2 == 0) return list.assign(objectsOf(state, table));
    list.assign(objectsOf(state, table).view());
  }
  void refuse(const Objects& objects) {
    State bad = stateOf(objects.view());
    if (bad.empty()) return;
    std::vector<std::byte> bytes(objects.view().data,
                                 objects.view().data + objects.size() * table.object_size);
    Decal decal;
    std::memcpy(&decal, bytes.data(), sizeof decal);
    decal.colour[1] = 2;
    std::memcpy(bytes.data(), &decal, sizeof decal);
    const View view{&table, bytes.data(), objects.size()};
    Object one = bad[0];
    one.values[kColour].numbers[1] = 2;
    EXPECT_ERROR(ErrorId::kObjectField, list.add(view));
    EXPECT_ERROR(ErrorId::kObjectField, list.replace(view));
    EXPECT_ERROR(ErrorId::kObjectField, list.assign(view));
    EXPECT_ERROR(ErrorId::kObjectField, list.add(one));
    if (list.size() > 0) EXPECT_ERROR(ErrorId::kObjectField, list.set(0, one));
    EXPECT_ERROR(ErrorId::kObjectIndex, list.set(list.size(), bad[0]));
    EXPECT_ERROR(ErrorId::kObjectIndex, list.remove(list.size()));
  }
  void change() {
    const Objects objects = randomObjects(random, random() % 5, table);
    switch (random() % 20) {
      case 0:
        if (!model.state().empty()) model.change({});
        list.clear();
        break;
      case 1:
        if (!model.state().empty() || objects.size() > 0) model.change(stateOf(objects.view()));
        if (random() % 2 == 0) {
          list.replace(Objects(objects));
        } else {
          list.replace(objects.view());
        }
        break;
      case 2:
      case 3:
      case 4:
      case 5:
        if (model.now > 0) model.walk(model.now - 1);
        list.undo();
        break;
      case 6:
      case 7:
      case 8:
        if (model.now + 1 < model.states.size()) model.walk(model.now + 1);
        list.redo();
        break;
      case 9:
        refuse(objects);
        break;
      case 10:
      case 11:
        if (objects.size() > 0) set(objects.view().object(0));
        break;
      case 12:
        if (!model.state().empty()) set(model.state()[0]);
        break;
      case 13:
        remove();
        break;
      case 14:
        move();
        break;
      case 15:
        if (random() % 4 == 0) assign(objects);
        break;
      default:
        add(objects);
    }
  }
};

TEST(ObjectList, DoesAsANaiveListDoes) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    Both both(seed % 2 == 0 ? kDecals : kPlainDecals, seed);
    for (int step = 0; step < 200; ++step) {
      both.change();
      const auto& [table, list, model, random] = both;
      ASSERT_EQ(stateOf(list.view()), model.state()) << "seed " << seed << " step " << step;
      ASSERT_EQ(list.canUndo(), model.now > 0) << "seed " << seed << " step " << step;
      ASSERT_EQ(list.canRedo(), model.now + 1 < model.states.size());
      ASSERT_EQ(list.revision() + 1, model.revisions.size()) << "seed " << seed << " step " << step;
      const size_t since = both.random() % model.revisions.size();
      ASSERT_LE(list.keptSince(since), model.keptSince(since))
          << "seed " << seed << " step " << step << " since " << since;
    }
  }
}

TEST(ObjectList, AddingAndUndoingKeepsAllThatItCan) {
  std::mt19937_64 random(1);
  ObjectList list(kDecals);
  EXPECT_EQ(list.keptSince(0), 0u);
  std::vector<size_t> counts = {0};  // number of objects at each revision
  for (int i = 0; i < 500; ++i) {
    if (random() % 3 == 0) {
      list.undo();
    } else {
      list.add(randomObjects(random, 1 + random() % 4).view());
    }
    if (list.revision() == counts.size()) counts.push_back(list.size());
  }
  for (size_t since = 0; since < counts.size(); ++since) {
    EXPECT_EQ(list.keptSince(since),
              *std::min_element(counts.begin() + static_cast<std::ptrdiff_t>(since), counts.end()));
  }
  EXPECT_EQ(list.keptSince(counts.size()), 0u);
}

TEST(ObjectList, AssigningKeepsExactlyTheCommonBeginning) {
  for (const Table* table : {&kDecals, &kPlainDecals}) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 200; ++i) {
      ObjectList list(*table);
      Objects first = randomObjects(random, random() % 20, *table), second(*table);
      list.assign(first.view());
      const uint64_t revision = list.revision();
      const size_t common = first.size() == 0 ? 0 : random() % (first.size() + 1);
      second.append(View{table, first.view().data, common});
      second.append(randomObjects(random, random() % 3, *table).view());
      list.assign(second.view());
      EXPECT_EQ(list.keptSince(revision), common);
      EXPECT_TRUE(sameObjects(list.view(), second.view()));
    }
  }
}

// Structs of a host may hold any bytes between their fields, and -0.
TEST(ObjectList, AssigningComparesFieldsAlone) {
  struct Padded {
    double position[3];
    float direction[3];
    uint32_t between;
  };
  static_assert(sizeof(Padded) == 40);
  const Field fields[] = {kDecalFields[kPosition], kDecalFields[kDirection]};
  const Table table = plugin::objects<Padded>({.key = "decals",
                                               .label = "Decals",
                                               .tooltip = "Padded",
                                               .fields = fields,
                                               .pointField = 0,
                                               .directionField = 1});
  std::vector<Padded> given(9, {{1, -0.0, 3}, {0, 1, -0.0f}, 0});
  const auto view = [&] {
    for (Padded& one : given) ++one.between;
    return View{&table, reinterpret_cast<const std::byte*>(given.data()), given.size()};
  };
  ObjectList list(table);
  list.assign(view());
  const uint64_t revision = list.revision();
  list.assign(view());
  EXPECT_EQ(list.revision(), revision);
  given[5].position[1] = 7;
  list.assign(view());
  EXPECT_EQ(list.keptSince(revision), 5u);
  Padded last;
  std::memcpy(&last, list.view().data + 8 * sizeof(Padded), sizeof last);
  EXPECT_EQ(last.between, 0u);
}

TEST(ObjectList, ClearingAndUndoingMovesNoObject) {
  std::mt19937_64 random(3);
  const Objects objects = randomObjects(random, 1000);
  ObjectList list(kDecals);
  list.add(objects.view());
  const std::byte* data = list.view().data;
  list.clear();
  EXPECT_EQ(list.size(), 0u);
  list.undo();
  EXPECT_EQ(list.view().data, data);
  EXPECT_TRUE(sameObjects(list.view(), objects.view()));
}

TEST(ObjectList, TakesOverLoadedObjectsWithoutACopy) {
  std::mt19937_64 random(7);
  Objects objects = randomObjects(random, 1000, kPlainDecals);
  const Objects same(objects);
  const std::byte* data = objects.view().data;
  ObjectList list(kPlainDecals);
  list.add(std::move(objects));
  EXPECT_EQ(list.view().data, data);
  list.undo();
  EXPECT_EQ(list.size(), 0u);
  list.redo();
  EXPECT_EQ(list.view().data, data);
  EXPECT_TRUE(sameObjects(list.view(), same.view()));
}

TEST(ObjectList, MayBeGivenItsOwnObjects) {
  for (const Table* table : {&kDecals, &kPlainDecals}) {
    std::mt19937_64 random(4);
    ObjectList list(*table);
    list.add(randomObject(random, *table));
    for (int i = 0; i < 5; ++i) list.add(list.view());
    for (int i = 0; i < 5; ++i) {
      list.assign(list.view());
      list.replace(list.view());
      list.add(list.view());
    }
    ASSERT_EQ(list.size(), 1024u);
    for (size_t i = 0; i < 1024; ++i) ASSERT_EQ(list.object(i), list.object(0));
    const View tail{table, list.view().data + 1000 * table->object_size, 24};
    list.assign(tail);
    EXPECT_EQ(list.size(), 24u);
    EXPECT_EQ(list.object(23), list.object(0));
  }
}

TEST(ObjectList, AFailureLeavesWhatCanBeRedone) {
  std::mt19937_64 random(5);
  const Objects one = randomObjects(random, 1);
  ObjectList list(kDecals);
  list.add(one.view());
  list.undo();
  const uint64_t revision = list.revision();
  Object bad = one.view().object(0);
  bad.values[kDirection].numbers = {};
  EXPECT_ERROR(ErrorId::kObjectField, list.add(bad));
  EXPECT_EQ(list.revision(), revision);
  ASSERT_TRUE(list.canRedo());
  list.redo();
  EXPECT_TRUE(sameObjects(list.view(), one.view()));
}

TEST(ObjectList, ARefusalNamesTheObjectByItsPlaceInTheArgument) {
  ObjectList list(kDecals);
  std::vector<Decal> raw(5, {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 1, "", ""});
  const View view{&kDecals, reinterpret_cast<const std::byte*>(raw.data()), raw.size()};
  list.assign(view);
  raw[3].size = 1e9;
  try {
    list.assign(view);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.detail(), "decals[3].size is 1000000000, out of -1 to 1000000");
  }
  EXPECT_EQ(list.size(), 5u);
  EXPECT_EQ(list.object(3).values[kSize].numbers[0], 1);
}

TEST(ObjectList, ATableOfTheSameLayoutTakesOverObjectsAndSteps) {
  std::mt19937_64 random(6);
  ObjectList list(kDecals);
  list.add(randomObjects(random, 3).view());
  list.add(randomObjects(random, 2).view());
  list.undo();
  const State before = stateOf(list.view());
  const uint64_t revision = list.revision();
  std::vector<Field> fields(std::begin(kDecalFields), std::end(kDecalFields));
  fields[kSize].tooltip = "Other words";
  Table other = kDecals;
  other.fields = fields.data();
  ASSERT_TRUE(list.adopt(other));
  EXPECT_EQ(&list.table(), &other);
  EXPECT_EQ(stateOf(list.view()), before);
  EXPECT_EQ(list.revision(), revision);
  list.redo();
  EXPECT_EQ(list.size(), 5u);

  const std::vector<std::function<void(Table&, std::vector<Field>&)>> changes = {
      [](Table& t, auto&) { t.key = "stickers"; },
      [](Table& t, auto&) { t.object_size += 8; },
      [](Table& t, auto&) { --t.field_count; },
      [](Table&, auto& f) { f[kSize].max = 5; },
      [](Table&, auto& f) { f[kSize].key = "width"; },
      [](Table&, auto& f) { std::swap(f[kDirection].offset, f[kColour].offset); },
      [](Table&, auto& f) { std::swap(f[kDirection].type, f[kColour].type); }};
  for (size_t i = 0; i < changes.size(); ++i) {
    std::vector<Field> changedFields = fields;
    Table changed = other;
    changed.fields = changedFields.data();
    changes[i](changed, changedFields);
    EXPECT_FALSE(list.adopt(changed)) << i;
    EXPECT_EQ(&list.table(), &other);
  }
}

}  // namespace
}  // namespace grisaille::objects
