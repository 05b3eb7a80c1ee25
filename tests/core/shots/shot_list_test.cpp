// SPDX-License-Identifier: MIT
#include "core/shots/shot_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/core/shots/random_shots.h"
#include "tests/support/expect_error.h"

namespace grisaille::shots {
namespace {

using Shots = std::vector<grisaille_shot>;

// Keeps every list that ever was.
struct Model {
  std::vector<Shots> states = {{}};  // what undo and redo walk along
  size_t now = 0;
  std::vector<Shots> revisions = {{}};

  const Shots& shots() const { return states[now]; }
  void change(Shots shots) {
    states.resize(now + 1);
    states.push_back(std::move(shots));
    ++now;
    revisions.push_back(states[now]);
  }
  void walk(size_t to) {
    now = to;
    revisions.push_back(states[now]);
  }
  // The most that keptSince may say: what all lists since then begin with.
  size_t keptSince(size_t revision) const {
    size_t kept = revisions[revision].size();
    for (size_t r = revision + 1; r < revisions.size(); ++r) {
      const Shots& later = revisions[r];
      kept = std::min(kept, later.size());
      for (size_t i = 0; i < kept; ++i) {
        if (!sameShot(later[i], revisions[revision][i])) kept = i;
      }
    }
    return kept;
  }
};

void changeBoth(ShotList& list, Model& model, std::mt19937_64& random) {
  const Shots shots = randomShots(random, random() % 5);
  switch (random() % 16) {
    case 0:
      if (!model.shots().empty()) model.change({});
      list.clear();
      break;
    case 1:
      if (!model.shots().empty() || !shots.empty()) model.change(shots);
      list.replace(shots);
      break;
    case 2:
    case 3:
    case 4:
    case 5:
    case 6:
      if (model.now > 0) model.walk(model.now - 1);
      list.undo();
      break;
    case 7:
    case 8:
    case 9:
      if (model.now + 1 < model.states.size()) model.walk(model.now + 1);
      list.redo();
      break;
    case 10: {
      if (shots.empty()) break;
      Shots bad = shots;
      bad[random() % bad.size()].color[1] = 2;
      EXPECT_ERROR(ErrorId::kShotColor, list.fire(bad));
      EXPECT_ERROR(ErrorId::kShotColor, list.replace(bad));
      break;
    }
    default: {
      Shots longer = model.shots();
      longer.insert(longer.end(), shots.begin(), shots.end());
      if (!shots.empty()) model.change(longer);
      list.fire(shots);
    }
  }
}

TEST(ShotList, DoesAsANaiveListDoes) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    std::mt19937_64 random(seed);
    ShotList list;
    Model model;
    for (int step = 0; step < 200; ++step) {
      changeBoth(list, model, random);
      ASSERT_TRUE(sameShots(list.shots(), model.shots())) << "seed " << seed << " step " << step;
      ASSERT_EQ(list.canUndo(), model.now > 0);
      ASSERT_EQ(list.canRedo(), model.now + 1 < model.states.size());
      ASSERT_EQ(list.revision() + 1, model.revisions.size());
      const size_t since = random() % model.revisions.size();
      ASSERT_LE(list.keptSince(since), model.keptSince(since))
          << "seed " << seed << " step " << step << " since " << since;
    }
  }
}

TEST(ShotList, FiringAndUndoingKeepsWhatItCan) {
  std::mt19937_64 random(1);
  ShotList list;
  EXPECT_EQ(list.keptSince(0), 0u);
  std::vector<size_t> counts = {0};  // at each revision
  for (int i = 0; i < 500; ++i) {
    if (random() % 3 == 0) {
      list.undo();
    } else {
      list.fire(randomShots(random, 1 + random() % 4));
    }
    if (list.revision() == counts.size()) counts.push_back(list.shots().size());
  }
  for (size_t since = 0; since < counts.size(); ++since) {
    EXPECT_EQ(list.keptSince(since),
              *std::min_element(counts.begin() + static_cast<std::ptrdiff_t>(since), counts.end()));
  }
  EXPECT_EQ(list.keptSince(counts.size()), 0u);
}

TEST(ShotList, ClearingKeepsTheShotsWhereTheyAre) {
  std::mt19937_64 random(3);
  const Shots shots = randomShots(random, 1000);
  ShotList list;
  list.fire(shots);
  const grisaille_shot* data = list.shots().data();
  list.clear();
  EXPECT_TRUE(list.shots().empty());
  list.undo();
  EXPECT_EQ(list.shots().data(), data);
  EXPECT_TRUE(sameShots(list.shots(), shots));
}

TEST(ShotList, MayFireItsOwnShots) {
  std::mt19937_64 random(4);
  ShotList list;
  list.fire(randomShot(random));
  for (int i = 0; i < 10; ++i) list.fire(list.shots());
  ASSERT_EQ(list.shots().size(), 1024u);
  for (const grisaille_shot& shot : list.shots()) EXPECT_TRUE(sameShot(shot, list.shots()[0]));
}

TEST(ShotList, AFailureLeavesWhatCanBeRedone) {
  std::mt19937_64 random(5);
  const grisaille_shot shot = randomShot(random);
  ShotList list;
  list.fire(shot);
  list.undo();
  const uint64_t revision = list.revision();
  grisaille_shot bad = shot;
  bad.direction[0] = bad.direction[1] = bad.direction[2] = 0;
  EXPECT_ERROR(ErrorId::kShotDirection, list.fire(bad));
  EXPECT_EQ(list.revision(), revision);
  ASSERT_TRUE(list.canRedo());
  list.redo();
  EXPECT_TRUE(sameShots(list.shots(), std::span(&shot, 1)));
}

}  // namespace
}  // namespace grisaille::shots
