// SPDX-License-Identifier: MIT
#include "app/viewer/effect_list.h"

#include <algorithm>
#include <functional>

#include "tests/support/expect_error.h"
#include "tests/support/tables.h"

namespace grisaille::app::viewer {
namespace {

std::vector<std::string> keysOf(const EffectList& list) {
  std::vector<std::string> keys;
  for (const EffectList::Entry& entry : list.entries()) keys.emplace_back(entry.key());
  return keys;
}

TEST(EffectList, BeginsWithAllOffByKeyAtTheirDefaults) {
  const Tables tables;
  EffectList list(tables.registry);
  EXPECT_EQ(keysOf(list), (std::vector<std::string>{"alpha", "beta", "gamma"}));
  for (const EffectList::Entry& entry : list.entries()) {
    EXPECT_FALSE(entry.on);
    EXPECT_EQ(entry.values.get("amount"), 0.5);
    EXPECT_EQ(entry.values.text("kind"), "second");
  }
  ASSERT_NE(list.find("beta"), nullptr);
  EXPECT_STREQ(list.find("beta")->key(), "beta");
  EXPECT_EQ(list.find("delta"), nullptr);
}

TEST(EffectList, MovingTakesOneOutAndPutsItIn) {
  const Tables tables;
  for (size_t from = 0; from < 5; ++from) {
    for (size_t to = 0; to < 5; ++to) {
      EffectList list(tables.registry);
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

TEST(EffectList, RestoringBringsBackEveryBitWhateverCameAfter) {
  const Tables tables;
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    EffectList list(tables.registry);
    randomise(random, list);
    const EffectList copy = list;
    const EffectList::State state = list.state();
    randomise(random, list);
    EXPECT_TRUE(list.restore(state).empty());
    ASSERT_TRUE(same(list, copy)) << i;
    EXPECT_EQ(list.state(), state);
  }
}

TEST(EffectList, RestoringAPartLeavesTheRestBehindAndOff) {
  const Tables tables;
  EffectList list(tables.registry);
  for (EffectList::Entry& entry : list.entries()) {
    entry.on = true;
    entry.values.set("count", 7.0);
  }
  const EffectList::State part = {{{.key = "gamma", .on = true, .values = {{"amount", "2"}}}}};
  EXPECT_TRUE(list.restore(part).empty());
  EXPECT_EQ(keysOf(list), (std::vector<std::string>{"gamma", "alpha", "beta"}));
  EXPECT_TRUE(list.entries()[0].on);
  EXPECT_EQ(list.entries()[0].values.get("amount"), 2);
  EXPECT_EQ(list.entries()[0].values.get("count"), 3);  // a default: the state names the effect
  EXPECT_FALSE(list.entries()[1].on);
  EXPECT_EQ(list.entries()[1].values.get("count"), 7);
}

TEST(EffectList, RestoringNamesWhatItDrops) {
  const Tables tables;
  EffectList list(tables.registry);
  const EffectList::State state = {
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

TEST(EffectList, ALaterVersionOfAPluginKeepsWhatStillFits) {
  const Tables now, later("later");
  std::mt19937_64 random(2);
  for (int i = 0; i < 300; ++i) {
    EffectList old(now.registry);
    randomise(random, old);
    std::vector<std::string> dropped;
    EffectList fresh = EffectList::rebound(old, later.registry, dropped);
    ASSERT_EQ(fresh.entries().size(), 2u);
    size_t expected = 1;  // gamma
    size_t place = 0;
    for (const EffectList::Entry& entry : old.entries()) {
      if (std::string_view(entry.key()) == "gamma") continue;
      const EffectList::Entry& kept = fresh.entries()[place++];
      EXPECT_STREQ(kept.key(), entry.key());
      EXPECT_EQ(kept.on, entry.on);
      EXPECT_EQ(kept.values.get("count"), entry.values.get("count"));
      const bool inside = std::abs(entry.values.get("amount")) <= 10;
      EXPECT_EQ(kept.values.get("amount"), inside ? entry.values.get("amount") : 0.5);
      const std::string kind = entry.values.text("kind");
      const bool there = kind == "first" || kind == "1e5";
      EXPECT_EQ(kept.values.text("kind"), there ? kind : "1e5");
      expected += 1u + (inside ? 0u : 1u) + (there ? 0u : 1u);  // `hard` is gone
    }
    EXPECT_EQ(dropped.size(), expected);
    std::vector<std::string> back;
    EffectList again = EffectList::rebound(fresh, now.registry, back);
    EXPECT_EQ(back.size(), 2u);  // `soft`, of two effects
  }
}

TEST(EffectList, SettingsMakeTheSameListElsewhere) {
  const Tables tables;
  std::mt19937_64 random(3);
  for (int i = 0; i < 500; ++i) {
    EffectList list(tables.registry), other(tables.registry);
    randomise(random, list);
    randomise(random, other);
    const EffectList before = other;
    other.apply(list.settings());
    std::vector<EffectList::Entry> expected;
    for (const EffectList::Entry& entry : list.entries()) {
      if (entry.on) expected.push_back(entry);
    }
    for (EffectList::Entry entry : before.entries()) {
      if (list.find(entry.key())->on) continue;
      entry.on = false;
      expected.push_back(entry);
    }
    ASSERT_TRUE(std::ranges::equal(other.entries(), expected,
                                   [](const auto& a, const auto& b) { return same(a, b); }));
  }
}

TEST(EffectList, AppliedEffectsBeginWithTheirDefaults) {
  const Tables tables;
  EffectList list(tables.registry);
  list.find("beta")->values.set("count", 9.0);
  list.apply({.effects = {{"beta"}},
              .surface = {},
              .values = {{.effect = "beta", .key = "amount", .text = "4", .place = {}}}});
  EXPECT_STREQ(list.entries()[0].key(), "beta");
  EXPECT_EQ(list.entries()[0].values.get("amount"), 4);
  EXPECT_EQ(list.entries()[0].values.get("count"), 3);
}

TEST(EffectList, SettingsThatAreRefusedChangeNothing) {
  const Tables tables;
  std::mt19937_64 random(4);
  EffectList list(tables.registry);
  randomise(random, list);
  const EffectList before = list;
  const auto value = [](const char* effect, const char* key, const char* text) {
    return Settings{.effects = {{"gamma", "alpha"}},
                    .surface = {},
                    .values = {{.effect = "gamma", .key = "amount", .text = "1", .place = {}},
                               {.effect = effect, .key = key, .text = text, .place = "a.toml:7"}}};
  };
  const std::pair<ErrorId, Settings> cases[] = {
      {ErrorId::kEffectUnknown, {.effects = {{"alpha", "alpah"}}, .surface = {}, .values = {}}},
      {ErrorId::kEffectTwice, {.effects = {{"alpha", "alpha"}}, .surface = {}, .values = {}}},
      {ErrorId::kEffectUnknown, value("beta", "amount", "1")},
      {ErrorId::kParameterUnknown, value("alpha", "amont", "1")},
      {ErrorId::kParameterRange, value("alpha", "amount", "1e301")},
      {ErrorId::kParameterType, value("alpha", "count", "1.5")},
      {ErrorId::kEffectUnknown, {}},  // the default, ssao, is not here
  };
  for (const auto& [id, settings] : cases) {
    EXPECT_ERROR(id, list.apply(settings));
    EXPECT_TRUE(same(list, before));
  }
  try {
    list.apply(value("alpha", "count", "many"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.detail().rfind("a.toml:7: ", 0), 0u) << error.what();
  }
}

}  // namespace
}  // namespace grisaille::app::viewer
