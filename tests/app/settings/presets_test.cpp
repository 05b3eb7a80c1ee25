// SPDX-License-Identifier: MIT
// Recognises presets by their values, and decides which parameters a search may change.
#include "app/settings/presets.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/program/run.h"
#include "tests/support/expect_error.h"
#include "tests/support/selections.h"

namespace grisaille::app {
namespace {

using tests::randomise;
using tests::randomValue;
using tests::Tables;

// Random presets, each of some of the effect's parameters.
Presets randomPresets(std::mt19937_64& random, const effect::Effect& effect) {
  Presets presets;
  for (const char* name : kPresetNames) {
    effect::Values values(effect);
    app::Preset preset{.name = name, .error = 0.1, .cost = 1, .values = {}};
    for (const grisaille_param_desc& param : effect.params()) {
      if (random() % 2 == 0) continue;
      values.set(param.key, randomValue(random, param));
      preset.values.emplace_back(param.key, values.text(param.key));
    }
    presets.all.push_back(std::move(preset));
  }
  return presets;
}

TEST(PresetTest, IsKnownByItsValues) {
  const Tables tables;
  std::mt19937_64 random(1);
  for (const effect::Effect& effect : tables.registry.effects()) {
    for (int i = 0; i < 50; ++i) {
      const Presets presets = randomPresets(random, effect);
      std::set<std::string> named;
      for (const app::Preset& preset : presets.all) {
        for (const auto& [key, text] : preset.values) named.insert(key);
      }
      for (const app::Preset& preset : presets.all) {
        effect::Selection::Entry entry{.on = true, .values = effect::Values(effect)};
        randomise(random, entry);
        applyPreset(entry.values, presets, preset.name);
        const auto isFree = [&](const grisaille_param_desc& param) {
          return named.contains(param.key) || (param.flags & GRISAILLE_PARAM_LOOK) != 0;
        };
        for (const grisaille_param_desc& param : effect.params()) {
          if (!isFree(param)) entry.values.reset(param.key);
        }
        // Another preset may be found, but only if its values are the same.
        const app::Preset* const found = presetOf(entry.values, presets);
        ASSERT_NE(found, nullptr);
        effect::Values other = entry.values;
        applyPreset(other, presets, found->name);
        EXPECT_TRUE(std::ranges::equal(other.all(), entry.values.all()));
        // Of the parameters that no preset names, only those of look are free.
        for (const grisaille_param_desc& param : effect.params()) {
          effect::Values changed = entry.values;
          changed.set(param.key, randomValue(random, param));
          const app::Preset* const now = presetOf(changed, presets);
          const bool same = changed.get(param.key) == entry.values.get(param.key);
          if (!named.contains(param.key)) {
            EXPECT_EQ(now, same || isFree(param) ? found : nullptr) << param.key;
          }
          if (now == nullptr) continue;
          effect::Values applied = changed;
          applyPreset(applied, presets, now->name);
          EXPECT_TRUE(std::ranges::equal(applied.all(), changed.all()));
        }
      }
    }
  }
}

// A preset's own look goes with it; a look that the user chose stays.
TEST(PresetTest, AnotherPresetKeepsTheLook) {
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  const effect::Effect& ssao = registry.find("ssao");
  const Presets presets = loadPresets(ssao);
  effect::Values values(ssao);
  EXPECT_EQ(presetOf(values, presets)->name, "balanced");  // the defaults
  applyPreset(values, presets, "classic");
  EXPECT_EQ(values.text("estimator"), "classic");
  EXPECT_GT(values.get("intensity"), 1);
  applyPreset(values, presets, "fast");
  EXPECT_EQ(values.get("intensity"), 1);
  values.set("intensity", "1.3");
  applyPreset(values, presets, "balanced");
  EXPECT_EQ(values.get("intensity"), 1.3);
  EXPECT_EQ(presetOf(values, presets)->name, "balanced");
  // Nobody has measured it at another radius than the scene's.
  values.set("radius", "0.7");
  EXPECT_EQ(presetOf(values, presets), nullptr);
  values.fit("radius", 0.7);
  EXPECT_EQ(presetOf(values, presets)->name, "balanced");
}

TEST(PresetTest, AFileMayHoldMorePresets) {
  const tests::TemporaryFolder folder;
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  effect::Effect ssao = registry.find("ssao");
  Presets presets = loadPresets(ssao);
  ssao.path = folder / "ssao.so";
  const auto with = [&](const std::string& name) {
    Presets all = presets;
    all.all.push_back(all.all.front());
    all.all.back().name = name;
    folder.write("ssao.presets.toml", presetsToml(all));
    return loadPresets(ssao);
  };
  EXPECT_EQ(with("mine_2").find("ssao", "mine_2").values, presets.all.front().values);
  EXPECT_EQ(with("mine_2").all.size(), presets.all.size() + 1);
  for (const char* wrong : {"Mine", "2", "\"a b\"", "_a"}) {
    EXPECT_ERROR(ErrorId::kPresetFile, with(wrong));
  }
}

TEST(PresetTest, ASearchChangesNeitherLooksNorWhatIsFoldedAwayUnlessAPresetNamesIt) {
  const Tables tables;
  std::mt19937_64 random(2);
  for (effect::Effect effect : tables.registry.effects()) {
    std::vector<grisaille_param_desc> params(effect.params().begin(), effect.params().end());
    for (grisaille_param_desc& param : params) {
      if (random() % 2 == 0) param.flags |= GRISAILLE_PARAM_ADVANCED;
      if (random() % 3 == 0) param.flags |= GRISAILLE_PARAM_LOOK;
    }
    grisaille_effect_desc desc = *effect.desc;
    desc.params = params.data();
    effect.desc = &desc;
    const Presets presets = randomPresets(random, effect);
    const auto named = [&](const grisaille_param_desc& param) {
      return std::ranges::any_of(presets.all, [&](const app::Preset& preset) {
        return std::ranges::any_of(preset.values,
                                   [&](const auto& value) { return value.first == param.key; });
      });
    };
    const auto all = tunable(effect, presets);
    for (const grisaille_param_desc& param : params) {
      const bool folded = (param.flags & GRISAILLE_PARAM_ADVANCED) != 0;
      const bool look = (param.flags & GRISAILLE_PARAM_LOOK) != 0;
      EXPECT_EQ(std::ranges::count(all, &param), !look && (!folded || named(param)) ? 1 : 0)
          << param.key;
    }
  }
}

}  // namespace
}  // namespace grisaille::app
