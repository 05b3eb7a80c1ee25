// SPDX-License-Identifier: MIT
#include "core/effect/selection.h"

#include <algorithm>

#include "tests/support/expect_error.h"
#include "tests/support/selections.h"

namespace grisaille::effect {
namespace {

using tests::randomise;
using tests::same;
using tests::Tables;

std::vector<std::string> keysOf(const Selection& list) {
  std::vector<std::string> keys;
  for (const Selection::Entry& entry : list.entries()) keys.emplace_back(entry.key());
  return keys;
}

TEST(Selection, BeginsWithAllOffByKeyAtTheirDefaults) {
  const Tables tables;
  Selection list(tables.registry);
  EXPECT_EQ(keysOf(list), (std::vector<std::string>{"alpha", "beta", "gamma"}));
  for (const Selection::Entry& entry : list.entries()) {
    EXPECT_FALSE(entry.on);
    EXPECT_EQ(entry.values.get("amount"), 0.5);
    EXPECT_EQ(entry.values.text("kind"), "second");
  }
  ASSERT_NE(list.find("beta"), nullptr);
  EXPECT_STREQ(list.find("beta")->key(), "beta");
  EXPECT_EQ(list.find("delta"), nullptr);
}

TEST(Selection, MovingTakesOneOutAndPutsItIn) {
  const Tables tables;
  for (size_t from = 0; from < 5; ++from) {
    for (size_t to = 0; to < 5; ++to) {
      Selection list(tables.registry);
      std::vector<std::string> expected = keysOf(list);
      list.move(from, to);
      if (from < 3 && to < 3) {
        const std::string key = expected[from];
        expected.erase(expected.begin() + static_cast<ptrdiff_t>(from));
        expected.insert(expected.begin() + static_cast<ptrdiff_t>(to), key);
      }
      EXPECT_EQ(keysOf(list), expected) << from << " to " << to;
    }
  }
}

TEST(Selection, RestoringBringsBackEveryBitWhateverCameAfter) {
  const Tables tables;
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    Selection list(tables.registry);
    randomise(random, list);
    const Selection copy = list;
    const Selection::State state = list.state();
    randomise(random, list);
    EXPECT_TRUE(list.restore(state).empty());
    ASSERT_TRUE(same(list, copy)) << i;
    EXPECT_EQ(list.state(), state);
  }
}

TEST(Selection, RestoringAPartLeavesTheRestBehindAndOff) {
  const Tables tables;
  Selection list(tables.registry);
  for (Selection::Entry& entry : list.entries()) {
    entry.on = true;
    entry.values.set("count", 7.0);
  }
  const Selection::State part = {{{.key = "gamma", .on = true, .values = {{"amount", "2"}}}}};
  EXPECT_TRUE(list.restore(part).empty());
  EXPECT_EQ(keysOf(list), (std::vector<std::string>{"gamma", "alpha", "beta"}));
  EXPECT_TRUE(list.entries()[0].on);
  EXPECT_EQ(list.entries()[0].values.get("amount"), 2);
  EXPECT_EQ(list.entries()[0].values.get("count"), 3);  // default: not in the state
  EXPECT_FALSE(list.entries()[1].on);
  EXPECT_EQ(list.entries()[1].values.get("count"), 7);
}

TEST(Selection, RestoringNamesWhatItDrops) {
  const Tables tables;
  Selection list(tables.registry);
  const Selection::State state = {
      {{.key = "delta", .on = true, .values = {}},
       {.key = "beta",
        .on = true,
        .values = {{"amount", "much"}, {"nothing", "1"}, {"kind", "third"}, {"count", "5"}}},
       {.key = "beta", .on = false, .values = {{"count", "6"}}}}};
  const std::vector<std::string> dropped = list.restore(state);
  ASSERT_EQ(dropped.size(), 5u);
  const char* mentions[] = {"delta", "beta.amount", "nothing", "third", "twice"};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_NE(dropped[i].find(mentions[i]), std::string::npos) << dropped[i];
  }
  EXPECT_EQ(list.find("beta")->values.get("count"), 5);
  EXPECT_EQ(list.find("beta")->values.get("amount"), 0.5);
  EXPECT_TRUE(list.find("beta")->on);
}

std::vector<std::string> running(const Selection& list) {
  std::vector<std::string> keys;
  for (const Effect* effect : list.effects()) keys.emplace_back(effect->key());
  return keys;
}

using Keys = std::vector<std::string>;

TEST(Selection, NamedEffectsAreOnInTheirOrder) {
  const Tables tables;
  const Keys keys = {"gamma", "alpha"};
  Selection list(tables.registry, keys);
  EXPECT_EQ(keysOf(list), keys);
  EXPECT_EQ(running(list), keys);
  EXPECT_EQ(list.find("beta"), nullptr);
  EXPECT_TRUE(Selection(tables.registry, Keys()).entries().empty());
  EXPECT_TRUE(Selection().entries().empty());
}

TEST(Selection, EffectsThatAreOffDoNotRun) {
  const Tables tables;
  Selection list(tables.registry);
  EXPECT_TRUE(running(list).empty());
  list.find("gamma")->on = list.find("beta")->on = true;
  EXPECT_EQ(running(list), (Keys{"beta", "gamma"}));
  list.move(2, 0);
  EXPECT_EQ(running(list), (Keys{"gamma", "beta"}));
}

TEST(Selection, UnknownEffectsAndEffectsNamedTwiceAreRefused) {
  const Tables tables;
  EXPECT_ERROR(ErrorId::kEffectUnknown, Selection(tables.registry, Keys{"alpha", "alpah"}));
  EXPECT_ERROR(ErrorId::kEffectTwice, Selection(tables.registry, Keys{"alpha", "alpha"}));
}

TEST(Selection, OnlyEffectsThatAreOnAreSet) {
  const Tables tables;
  Selection list(tables.registry);
  EXPECT_ERROR(ErrorId::kEffectUnknown, list.values("beta"));
  list.find("beta")->on = true;
  list.set(Assignment{{"beta", "count"}, "8"});
  EXPECT_EQ(list.values("beta").get("count"), 8);
  list.set(ParameterValue{{"beta", "amount"}, 0.25});
  EXPECT_EQ(list.values("beta").get("amount"), 0.25);
  EXPECT_ERROR(ErrorId::kParameterUnknown, list.set(Assignment{{"beta", "cuont"}, "8"}));
  EXPECT_ERROR(ErrorId::kEffectUnknown, list.set(Assignment{{"alpha", "count"}, "8"}));
  EXPECT_ERROR(ErrorId::kEffectUnknown, list.set(Assignment{{"delta", "count"}, "8"}));
  EXPECT_ERROR(ErrorId::kEffectUnknown, Selection().values("alpha"));
}

TEST(ParameterName, IsTheTextBeforeTheFirstEqualsSign) {
  EXPECT_EQ(parseParameterName("a.b.c"), (ParameterName{"a", "b.c"}));
  EXPECT_EQ(parseAssignment("a.b=c=d"), (Assignment{{"a", "b"}, "c=d"}));
  EXPECT_EQ(parseAssignment("a.b=").value, "");
  for (const char* text : {"ssao.radius=0.5", "a.b=x.y", "a.b=="}) {
    EXPECT_EQ(parseAssignment(text).text(), text);
  }
  for (const char* text : {"", ".", "a.", ".b", "ab"}) {
    EXPECT_ERROR(ErrorId::kUsage, parseParameterName(text));
  }
  for (const char* text : {"", "=", "a=b", "a.b", "a=b.c", "."}) {
    EXPECT_ERROR(ErrorId::kUsage, parseAssignment(text));
  }
}

}  // namespace
}  // namespace grisaille::effect
