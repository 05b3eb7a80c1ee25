// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/effect/registry.h"

namespace grisaille::effect {
namespace {

struct SearchPathsTest : testing::Test {
  void TearDown() override { unsetenv("GRISAILLE_EFFECT_PATH"); }
};

TEST_F(SearchPathsTest, BesideTheProgramThenVariableThenExtra) {
  setenv("GRISAILLE_EFFECT_PATH", ":/a::b/c:", 1);
  const std::string extra[] = {"/x", "y"};
  const auto paths = searchPaths(extra);
  ASSERT_EQ(paths.size(), 5u);
  const auto program = std::filesystem::canonical("/proc/self/exe");
  EXPECT_EQ(paths[0].folder, program.parent_path().parent_path() / "lib/grisaille/effects");
  EXPECT_FALSE(paths[0].required);
  const char* const rest[] = {"/a", "b/c", "/x", "y"};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(paths[i + 1].folder, rest[i]);
    EXPECT_TRUE(paths[i + 1].required);
  }
}

TEST_F(SearchPathsTest, NothingSetLeavesTheFirst) {
  EXPECT_EQ(searchPaths({}).size(), 1u);
  setenv("GRISAILLE_EFFECT_PATH", "", 1);
  EXPECT_EQ(searchPaths({}).size(), 1u);
}

}  // namespace
}  // namespace grisaille::effect
