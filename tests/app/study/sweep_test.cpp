// SPDX-License-Identifier: MIT
#include "app/study/sweep.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/program/run.h"
#include "tests/support/expect_error.h"

namespace grisaille::app::study {
namespace {

struct Effects : testing::Test {
  Effects() { registry.scan(EFFECTS_FOLDER); }
  effect::Registry registry;
};
using SweepTest = Effects;

TEST_F(SweepTest, ValuesAreNumbersWithTheEffectsOwnText) {
  const Sweep sweep = parseSweep(registry, "ssao.radius=0.50,1e0,2");
  EXPECT_EQ(sweep.name.text(), "ssao.radius");
  EXPECT_EQ(sweep.values, (std::vector<double>{0.5, 1, 2}));
  const Sweep blurs = parseSweep(registry, "ssao.blur=box,edge_aware");
  EXPECT_EQ(blurs.values, (std::vector<double>{0, 1}));
  const SettingText text = textOf(registry, {{sweep.name, 0.5}, {blurs.name, 1}});
  EXPECT_EQ(nameOf(text), "radius=0.5 blur=edge_aware");
}

TEST_F(SweepTest, MistakesAreNamed) {
  for (const char* text : {"", "ssao", "ssao.radius", "ssao.radius=", "=1", "ssao.radius=1,1.0"}) {
    SCOPED_TRACE(text);
    EXPECT_ERROR(ErrorId::kUsage, parseSweep(registry, text));
  }
  EXPECT_ERROR(ErrorId::kEffectUnknown, parseSweep(registry, "none.radius=1"));
  EXPECT_ERROR(ErrorId::kParameterUnknown, parseSweep(registry, "ssao.raduis=1"));
  EXPECT_ERROR(ErrorId::kParameterRange, parseSweep(registry, "ssao.kernel_size=8,5000"));
  EXPECT_ERROR(ErrorId::kParameterType, parseSweep(registry, "ssao.radius=1,,2"));
  const Sweep one = parseSweep(registry, "ssao.radius=1");
  EXPECT_ERROR(ErrorId::kUsage, gridOf({one, one}));
}

TEST_F(SweepTest, TheGridHasEveryCombinationOnce) {
  const auto grid = gridOf({parseSweep(registry, "ssao.kernel_size=4,8,16"),
                            parseSweep(registry, "ssao.radius=0.3,0.5")});
  EXPECT_EQ(grid.size(), 6u);
  std::set<std::string> names;
  for (const Setting& setting : grid) names.insert(nameOf(textOf(registry, setting)));
  EXPECT_EQ(names.size(), 6u);
  EXPECT_EQ(nameOf(textOf(registry, grid[1])), "kernel_size=4 radius=0.5");
  EXPECT_EQ(gridOf({}).size(), 1u);
  EXPECT_EQ(nameOf({}), "defaults");
}

TEST_F(SweepTest, EachLineOfAFileIsAGrid) {
  const tests::TemporaryFolder folder;
  const auto load = [&](const std::string& text) {
    return loadGrids(registry, folder.write("grids", text));
  };
  const std::vector<Setting> all =
      load("# of slices\nssao.kernel_size=4,8  ssao.radius=1 # both\n\nssao.bias=0.5\n");
  std::vector<std::string> names;
  for (const Setting& setting : all) names.push_back(nameOf(textOf(registry, setting)));
  EXPECT_EQ(names, (std::vector<std::string>{"kernel_size=4 radius=1", "kernel_size=8 radius=1",
                                             "bias=0.5"}));
  for (const char* none : {"", "\n", "# ssao.bias=0\n"}) {
    EXPECT_ERROR(ErrorId::kSettingsInvalid, load(none));
  }
  EXPECT_ERROR(ErrorId::kSettingsInvalid, load("ssao.bias=0,1\nssao.bias=1\n"));
  EXPECT_ERROR(ErrorId::kParameterRange, load("ssao.bias=-1"));
  EXPECT_ERROR(ErrorId::kUsage, load("ssao.bias=1 ssao.bias=2"));
  EXPECT_ERROR(ErrorId::kSettingsUnreadable, loadGrids(registry, folder / "none"));
  try {
    load("ssao.bias=1\nssao.bais=1\n");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(error.detail().find("grids:2: "), std::string::npos) << error.what();
  }
}

TEST(ShardTest, PartsMakeTheWhole) {
  for (uint32_t count = 1; count < 9; ++count) {
    std::vector<int> held(50, 0);
    for (uint32_t index = 1; index <= count; ++index) {
      const Shard shard = parseShard(std::to_string(index) + "/" + std::to_string(count));
      for (size_t i = 0; i < held.size(); ++i) held[i] += shard.holds(i) ? 1 : 0;
    }
    EXPECT_EQ(held, std::vector<int>(50, 1));
  }
  for (const char* text : {"", "1", "0/2", "3/2", "1/0", "a/b", "1/2x"}) {
    SCOPED_TRACE(text);
    EXPECT_ERROR(ErrorId::kUsage, parseShard(text));
  }
}

}  // namespace
}  // namespace grisaille::app::study
