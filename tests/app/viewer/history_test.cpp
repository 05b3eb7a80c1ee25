// SPDX-License-Identifier: MIT
#include "app/viewer/history.h"

#include <map>

#include "tests/core/objects/random_objects.h"
#include "tests/support/selections.h"

namespace grisaille::app::viewer {
namespace {

using tests::randomise;
using tests::randomValue;
using tests::Tables;

constexpr const char* kOwners[] = {"alpha", "beta"};

// The state that undo restores: settings and two lists of objects.
struct Studio {
  Tables tables;
  effect::Selection list{tables.registry};
  std::map<std::string, objects::ObjectList, std::less<>> lists;
  History history;

  Studio()
      : history(
            list.state(),
            [this](const effect::Selection::State& state) {
              EXPECT_TRUE(list.restore(state).empty());
            },
            [this](std::string_view effect) { return &lists.find(effect)->second; }) {
    for (const char* key : kOwners) lists.try_emplace(key, objects::kPlainDecals);
  }

  // Hash over every bit of the settings and the objects.
  uint64_t fingerprint() const {
    uint64_t hash = 14695981039346656037u;
    const auto mix = [&](uint64_t value) { hash = (hash ^ value) * 1099511628211u; };
    for (const effect::Selection::Entry& entry : list.entries()) {
      mix(static_cast<uint64_t>(entry.key()[0]) * 2 + entry.on);
      for (const double value : entry.values.all()) mix(std::bit_cast<uint64_t>(value));
    }
    for (const auto& [key, one] : lists) {
      mix(one.size());
      for (size_t i = 0; i < one.size(); ++i) {
        for (const objects::Value& value : one.object(i).values) {
          for (const double number : value.numbers) mix(std::bit_cast<uint64_t>(number));
        }
      }
    }
    return hash;
  }

  // Makes a random change and records it. Returns its name.
  std::string change(std::mt19937_64& random);
  size_t step(std::mt19937_64& random, objects::ObjectList& objects) const;
};

// One random step of the list, or none.
size_t Studio::step(std::mt19937_64& random, objects::ObjectList& objects) const {
  const uint64_t before = objects.revision();
  const auto some = [&](size_t most) {
    return objects::randomObjects(random, random() % most, objects::kPlainDecals);
  };
  if (random() % 16 == 0 || objects.size() > 40) {
    objects.clear();
  } else if (random() % 16 == 0) {
    objects.replace(some(4).view());
  } else if (random() % 16 == 0 && objects.size() > 0) {
    objects.remove(random() % objects.size());
  } else {
    objects.add(some(3).view());
  }
  return objects.revision() == before ? 0 : 1;
}

std::string Studio::change(std::mt19937_64& random) {
  std::string what = std::to_string(random());
  const size_t count = list.entries().size();
  effect::Selection::Entry& entry = list.entries()[random() % count];
  const auto params = entry.values.effect().params();
  const grisaille_param_desc& param = params[random() % params.size()];
  const std::string owner = kOwners[random() % 2];
  switch (random() % 8) {
    case 0:
      entry.on = !entry.on;
      break;
    case 1:
      list.move(random() % count, random() % count);
      break;
    case 2:
      randomise(random, list);
      break;
    case 3:
    case 4:
      entry.values.set(param.key, randomValue(random, param));
      break;
    default: {
      size_t steps = 0;
      for (size_t i = random() % 4; i > 0; --i) steps += step(random, lists.find(owner)->second);
      history.noteObjects(owner, steps, what);
      return what;
    }
  }
  history.noteSettings(list.state(), what);
  return what;
}

TEST(History, BeginsWithNothingToUndo) {
  Studio studio;
  EXPECT_FALSE(studio.history.canUndo());
  EXPECT_FALSE(studio.history.canRedo());
  EXPECT_EQ(studio.history.undoName(), "");
  EXPECT_EQ(studio.history.redoName(), "");
  studio.history.undo();
  studio.history.redo();
  studio.history.noteSettings(studio.list.state(), "nothing");
  studio.history.noteObjects("alpha", 0, "nothing");
  EXPECT_FALSE(studio.history.canUndo());
}

// A hundred thousand steps, undone to the beginning and redone to the end.
TEST(History, BringsBackEveryStateOfALongWalk) {
  constexpr size_t kSteps = 100000;
  Studio studio;
  std::mt19937_64 random(6);
  std::vector<uint64_t> states = {studio.fingerprint()};
  std::vector<std::string> names;
  while (names.size() < kSteps) {
    const std::string what = studio.change(random);
    if (studio.history.undoName() != what) {
      ASSERT_EQ(studio.fingerprint(), states.back());  // the step changed nothing
      continue;
    }
    names.push_back(what);
    states.push_back(studio.fingerprint());
  }
  for (size_t i = kSteps; i > 0; --i) {
    ASSERT_EQ(studio.history.undoName(), names[i - 1]);
    studio.history.undo();
    ASSERT_EQ(studio.fingerprint(), states[i - 1]) << i;
    ASSERT_EQ(studio.history.redoName(), names[i - 1]);
  }
  EXPECT_FALSE(studio.history.canUndo());
  for (size_t i = 0; i < kSteps; ++i) {
    studio.history.redo();
    ASSERT_EQ(studio.fingerprint(), states[i + 1]) << i;
  }
  EXPECT_FALSE(studio.history.canRedo());
}

// Changes, undo and redo in any order, compared with a plain list of all states.
TEST(History, ForgetsWhatWasUndoneBeforeAChange) {
  Studio studio;
  std::mt19937_64 random(7);
  std::vector<uint64_t> states = {studio.fingerprint()};
  std::vector<std::string> names = {""};
  size_t at = 0;
  for (int i = 0; i < 20000; ++i) {
    if (random() % 3 == 0) {
      studio.history.undo();
      if (at > 0) --at;
    } else if (random() % 3 == 0) {
      studio.history.redo();
      if (at + 1 < states.size()) ++at;
    } else {
      const std::string what = studio.change(random);
      if (studio.history.undoName() == what) {
        states.resize(++at);
        names.resize(at);
        states.push_back(studio.fingerprint());
        names.push_back(what);
      }
    }
    ASSERT_EQ(studio.fingerprint(), states[at]) << i;
    ASSERT_EQ(studio.history.undoName(), names[at]);
    ASSERT_EQ(studio.history.redoName(), at + 1 < names.size() ? names[at + 1] : "");
  }
}

TEST(History, AHeldSprayIsOneStep) {
  Studio studio;
  std::mt19937_64 random(8);
  objects::ObjectList& list = studio.lists.find("alpha")->second;
  const auto spray = [&](bool joins) {
    list.add(objects::randomObject(random, objects::kPlainDecals));
    studio.history.noteObjects("alpha", 1, "spray", joins);
  };
  spray(false);
  for (int i = 0; i < 99; ++i) spray(true);
  spray(false);
  spray(true);
  EXPECT_EQ(list.size(), 102u);
  studio.history.undo();
  EXPECT_EQ(list.size(), 100u);
  // An undo lies in between: the next shots begin a new stroke.
  spray(true);
  EXPECT_FALSE(studio.history.canRedo());
  studio.history.undo();
  EXPECT_EQ(list.size(), 100u);
  studio.history.undo();
  EXPECT_EQ(list.size(), 0u);
  EXPECT_FALSE(studio.history.canUndo());
  studio.history.redo();
  EXPECT_EQ(list.size(), 100u);
}

TEST(History, OnlyStrokesOfTheSameListJoin) {
  Studio studio;
  std::mt19937_64 random(9);
  const auto fire = [&](const char* effect) {
    studio.lists.find(effect)->second.add(objects::randomObject(random, objects::kPlainDecals));
    studio.history.noteObjects(effect, 1, effect, true);
  };
  fire("alpha");
  fire("beta");
  studio.list.entries()[0].on = true;
  studio.history.noteSettings(studio.list.state(), "on");
  fire("beta");
  for (const char* name : {"beta", "on", "beta", "alpha"}) {
    EXPECT_EQ(studio.history.undoName(), name);
    studio.history.undo();
  }
  EXPECT_FALSE(studio.history.canUndo());
}

// After a scan finds another set of effects, undo still reaches the steps before it.
TEST(History, ARescanIsAStepLikeAnyOther) {
  const Tables now, later("later");
  effect::Selection list(now.registry);
  std::vector<std::string> dropped;
  History history(
      list.state(), [&](const effect::Selection::State& state) { dropped = list.restore(state); },
      [](std::string_view) -> objects::ObjectList* { throw std::logic_error("no objects here"); });
  list.find("beta")->values.set("count", 4.0);
  history.noteSettings(list.state(), "count");
  effect::Selection rebound(later.registry);
  dropped = rebound.restore(list.state());
  list = rebound;
  history.noteSettings(list.state(), "rescan");
  list.find("beta")->values.set("count", 5.0);
  history.noteSettings(list.state(), "count again");
  history.undo();
  EXPECT_EQ(list.find("beta")->values.get("count"), 4);
  EXPECT_TRUE(dropped.empty());
  history.undo();
  EXPECT_EQ(list.find("beta")->values.get("count"), 4);
  EXPECT_FALSE(dropped.empty());  // gamma
  history.undo();
  EXPECT_EQ(list.find("beta")->values.get("count"), 3);
  for (int i = 0; i < 3; ++i) history.redo();
  EXPECT_EQ(list.find("beta")->values.get("count"), 5);
  EXPECT_TRUE(dropped.empty());
}

}  // namespace
}  // namespace grisaille::app::viewer
