// SPDX-License-Identifier: MIT
#include "app/settings/chosen_effects.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/selections.h"

namespace grisaille::app {
namespace {

using tests::same;
using tests::Tables;

TEST(ChosenEffects, SettingsMakeTheSameSelectionElsewhere) {
  const Tables tables;
  std::mt19937_64 random(3);
  for (int i = 0; i < 500; ++i) {
    effect::Selection selection(tables.registry);
    tests::randomise(random, selection);
    const Settings settings = settingsOf(selection);
    const effect::Selection again = chosenEffects(tables.registry, *settings.effects, {}, settings);
    std::vector<effect::Selection::Entry> expected;
    for (const effect::Selection::Entry& entry : selection.entries()) {
      if (entry.on) expected.push_back(entry);
    }
    ASSERT_TRUE(std::ranges::equal(again.entries(), expected,
                                   [](const auto& a, const auto& b) { return same(a, b); }));
  }
}

TEST(ChosenEffects, BeginWithTheirDefaults) {
  const Tables tables;
  const Settings settings{
      .effects = {},
      .surface = {},
      .values = {{.name = {.effect = "beta", .key = "amount"}, .text = "4", .place = {}}}};
  const effect::Selection selection = chosenEffects(tables.registry, {"beta"}, {}, settings);
  EXPECT_EQ(selection.find("beta")->values.get("amount"), 4);
  EXPECT_EQ(selection.find("beta")->values.get("count"), 3);
}

TEST(ChosenEffects, MistakesAreNamedByTheirPlace) {
  const Tables tables;
  const auto value = [](const char* effect, const char* key, const char* text) {
    return Settings{
        .effects = {},
        .surface = {},
        .values = {{.name = {.effect = effect, .key = key}, .text = text, .place = "a.toml:7"}}};
  };
  const std::vector<std::string> keys = {"gamma", "alpha"};
  const auto choose = [&](const std::vector<std::string>& which, const Settings& settings) {
    return chosenEffects(tables.registry, which, {}, settings);
  };
  EXPECT_ERROR(ErrorId::kEffectUnknown, choose({"alpha", "alpah"}, {}));
  EXPECT_ERROR(ErrorId::kEffectTwice, choose({"alpha", "alpha"}, {}));
  EXPECT_ERROR(ErrorId::kEffectUnknown, choose(keys, value("beta", "amount", "1")));
  EXPECT_ERROR(ErrorId::kParameterUnknown, choose(keys, value("alpha", "amont", "1")));
  EXPECT_ERROR(ErrorId::kParameterRange, choose(keys, value("alpha", "amount", "1e301")));
  EXPECT_ERROR(ErrorId::kParameterType, choose(keys, value("alpha", "count", "1.5")));
  try {
    choose(keys, value("alpha", "count", "many"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(error.detail().starts_with("a.toml:7: ")) << error.what();
  }
}

}  // namespace
}  // namespace grisaille::app
