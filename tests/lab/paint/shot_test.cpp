// SPDX-License-Identifier: MIT
#include "lab/paint/shot.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"

namespace grisaille::lab {
namespace {

class ShotTest : public ::testing::Test {
 protected:
  ShotTest() { registry_.scan(EFFECTS_FOLDER); }
  effect::Registry registry_;
};

TEST_F(ShotTest, ObjectsHoldEveryBitOfAShot) {
  const std::vector<Shot> shots = {
      {.origin = {1e9, -0.1, 3}, .direction = {0, 0.6f, -0.8f}, .color = {0.1f, 1, 0}, .range = 0},
      {.origin = {}, .direction = {1, 0, 0}, .color = {}, .range = 0.3}};
  const objects::Objects objects = objectsOf(shotTable(registry_), shots);
  const std::vector<Shot> again = shotsOf(objects.view());
  ASSERT_EQ(again.size(), shots.size());
  for (size_t i = 0; i < shots.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(again[i].origin, shots[i].origin)) << i;
    EXPECT_TRUE(std::ranges::equal(again[i].direction, shots[i].direction)) << i;
    EXPECT_TRUE(std::ranges::equal(again[i].color, shots[i].color)) << i;
    EXPECT_EQ(again[i].range, shots[i].range) << i;
  }
}

TEST_F(ShotTest, AShotThatTheTableRefusesIsNamed) {
  const std::vector<Shot> shots = {
      {.origin = {}, .direction = {1, 0, 0}, .color = {}, .range = 0},
      {.origin = {}, .direction = {1, 0, 0}, .color = {0, 2, 0}, .range = 0}};
  try {
    objectsOf(shotTable(registry_), shots);
    FAIL() << "a colour of 2 was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kObjectField);
    EXPECT_NE(error.detail().find("shots[1].color[1]"), std::string::npos) << error.detail();
  }
}

}  // namespace
}  // namespace grisaille::lab
