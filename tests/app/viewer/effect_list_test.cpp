// SPDX-License-Identifier: MIT
#include "app/viewer/effect_list.h"

#include <algorithm>
#include <functional>

#include "tests/support/expect_error.h"
#include "tests/support/tables.h"

namespace grisaille::app::viewer {
namespace {

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
