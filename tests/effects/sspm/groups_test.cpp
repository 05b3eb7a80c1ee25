// SPDX-License-Identifier: MIT
// What groups of shots reach in a cell: never less than their shots, and little more, so that
// pixels beside many shots at one place pass over them. They take memory only where that pays.
#include "effects/sspm/groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace grisaille::tests {
namespace {

using namespace sspm;

constexpr int kAWay = Squares::kAWay;

bool has(const Squares& squares, int half, int b, int row) {
  const int index = half * kAWay + row;
  return (squares.rows[static_cast<size_t>(index)] >> b & 1) != 0;
}

// A point's square, and its part of the cell. at: in cells from the cell's lower corner.
bool has(const CellReach& reach, const glm::vec3& at, int axis) {
  const glm::ivec3 square(glm::clamp(at * float{kAWay}, 0.0f, kAWay - 1.0f)), part = square / 4;
  return (reach.parts >> (part.x | part.y << 2 | part.z << 4) & 1) != 0 &&
         has(reach.squares, part[axis] / 2, square[(axis + 1) % 3], square[(axis + 2) % 3]);
}

// A shot onto a wall across axis 1, from above, in the lower two layers of parts.
// at: along axes 2 and 0, in cells.
CellReach onWall(const glm::vec2& at, float range) {
  constexpr uint64_t kTwoLayers = 0x00FF'00FF'00FF'00FF;
  return reachOf(kTwoLayers, 1, {at.y, 3, at.x}, {0, -1, 0}, range);
}

class GroupsTest : public ::testing::Test {
 protected:
  float unit() { return std::uniform_real_distribution<float>(0, 1)(random_); }
  glm::vec3 point() { return {unit(), unit(), unit()}; }
  glm::vec3 direction() {
    for (;;) {
      const glm::vec3 way = 2.0f * point() - 1.0f;
      if (glm::length(way) > 0.1f) return glm::normalize(way);
    }
  }

  std::mt19937 random_{3};
};

TEST_F(GroupsTest, AShotReachesAllPointsInItsRange) {
  size_t inRange = 0;
  for (int i = 0; i < 2000; ++i) {
    const int axis = i % 3;
    const glm::vec3 target = 2.0f * point() - 0.5f, way = direction();
    const glm::vec3 muzzle = target - way * (i % 2 == 0 ? 2 * unit() : 300 * unit());
    const float range = 0.05f + unit();
    const uint64_t parts = uint64_t{random_()} << 32 | random_();
    const CellReach reach = reachOf(parts, axis, muzzle, way, range);
    EXPECT_EQ(reach.parts, parts);
    for (int k = 0; k < 200; ++k) {
      const glm::vec3 at = point();
      const glm::ivec3 part(at * 4.0f);
      const bool touched = (parts >> (part.x | part.y << 2 | part.z << 4) & 1) != 0;
      if (!touched || glm::length(glm::cross(at - muzzle, way)) >= range) continue;
      ++inRange;
      ASSERT_TRUE(has(reach, at, axis)) << i;
    }
  }
  EXPECT_GT(inRange, 10'000u);
}

// Before a wall, no square lies farther beside the range than the slacks and its own width.
TEST_F(GroupsTest, AShotReachesLittleBesideItsRange) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 way(0);
    way[axis] = -1;
    const glm::vec3 muzzle = glm::vec3(0.5f) - 3.0f * way;
    const CellReach reach = reachOf(~uint64_t{0}, axis, muzzle, way, 0.3f);
    int count = 0;
    for (int b = 0; b < kAWay; ++b) {
      for (int row = 0; row < kAWay; ++row) {
        if (!has(reach.squares, 0, b, row)) continue;
        ++count;
        const glm::vec2 nearest = glm::max(
            glm::abs((glm::vec2(b, row) + 0.5f) / float{kAWay} - 0.5f) - 0.5f / kAWay, 0.0f);
        EXPECT_LT(glm::length(nearest), 0.3f + 0.5f / kAWay);
      }
    }
    EXPECT_GT(count, 3.14f * 0.3f * 0.3f * kAWay * kAWay);
  }
}

// Shots come and go at random, at one place and anywhere. Each mask has what the shots of its group
// reach, and no group is too large.
TEST_F(GroupsTest, HoldWhatTheirShotsReach) {
  Groups groups;
  std::vector<CellReach> shots;
  size_t masks = 0, without = 0;
  const auto check = [&] {
    size_t at = 0;
    const CellReach* mask = groups.masks();
    for (size_t i = 0; i < groups.size(); ++i) {
      const Groups::Group& group = groups[i];
      EXPECT_GT(group.count, 0u);
      EXPECT_LE(group.count, Groups::kMost);
      ++(group.mayPay() ? masks : without);
      for (const size_t end = at + group.count; at < end; ++at) {
        ASSERT_LT(at, shots.size());
        if (!group.mayPay()) continue;
        CellReach both = *mask;
        both |= shots[at];
        EXPECT_EQ(both.parts, mask->parts);
        EXPECT_EQ(both.squares.rows, mask->squares.rows);
      }
      if (group.mayPay()) ++mask;
    }
    EXPECT_EQ(at, shots.size());
  };
  for (int i = 0; i < 6000; ++i) {
    const size_t at = i % 3 == 0 ? 0 : i % 3 == 1 ? shots.size() : random_() % (shots.size() + 1);
    const float place = i / 40 % 3 == 0 ? unit() : 0.3f;
    const CellReach reach = onWall({place, 0.2f * unit()}, 0.3f);
    groups.insert(at, 1, [&] { return reach; });
    shots.insert(shots.begin() + static_cast<std::ptrdiff_t>(at), reach);
    if (i % 7 == 0) {
      const size_t which = random_() % shots.size();
      const CellReach more = onWall({unit(), unit()}, 0.02f);
      groups.extend(which, 1, [&] { return more; });
      shots[which] |= more;
    }
    if (i % 50 == 0) groups.widen(random_() % shots.size());
    if (i % 100 != 0) continue;
    check();
    Groups::Eraser eraser(groups, 1);
    const size_t share = random_() % 5;
    std::erase_if(shots, [&](const CellReach&) {
      const bool erased = random_() % 4 < share;
      eraser.next(erased);
      return erased;
    });
    eraser.finish();
    check();
  }
  EXPECT_GT(masks, 100u);
  EXPECT_GT(without, 100u);
}

// Of a group whose shots have all gone, nothing stays.
TEST_F(GroupsTest, ForgetShotsThatAreGone) {
  Groups groups;
  for (size_t i = 0; i < 3 * Groups::kMost; ++i) {
    groups.insert(
        i, 1, [&] { return CellReach{.parts = uint64_t{1} << i / Groups::kMost, .squares = {}}; });
  }
  Groups::Eraser eraser(groups, 1);
  for (size_t i = 0; i < 3 * Groups::kMost; ++i) eraser.next(i < 2 * Groups::kMost);
  eraser.finish();
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups.masks()->parts, 4u);
  EXPECT_EQ(groups[0].count, Groups::kMost);
}

// Around one place, a full group has a mask that pays. Shots that are spread have none: it would
// take memory, and spare pixels nothing.
TEST_F(GroupsTest, HaveMasksWhereTheyPay) {
  Groups place, spread, few;
  for (size_t i = 0; i < 4 * Groups::kMost; ++i) {
    place.insert(0, 1, [&] { return onWall(glm::vec2(0.3f) + 0.05f * unit(), 0.3f); });
    spread.insert(0, 1, [&] { return onWall({unit(), unit()}, 0.5f); });
  }
  few.insert(0, 1, [&] { return onWall({0.3f, 0.3f}, 0.3f); });
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(place[i].pays()) << i;
    EXPECT_FALSE(spread[i].mayPay()) << i;
  }
  EXPECT_TRUE(few[0].mayPay());
  EXPECT_FALSE(few[0].pays());
  EXPECT_GE(place.bytes(), 4 * sizeof(CellReach));
  EXPECT_LT(spread.bytes(), sizeof(CellReach));
}

// Groups are full where shots come at the ends, newest or oldest first.
TEST_F(GroupsTest, AreFullAtBothEnds) {
  Groups first, last;
  for (size_t i = 0; i < 20 * Groups::kMost; ++i) {
    first.insert(0, 1, [] { return CellReach{}; });
    last.insert(i, 1, [] { return CellReach{}; });
  }
  EXPECT_EQ(first.size(), 20u);
  EXPECT_EQ(last.size(), 20u);
}

}  // namespace
}  // namespace grisaille::tests
