// SPDX-License-Identifier: MIT
// What groups of shots reach in a cell: never less than their shots, and little more, so that
// pixels beside many shots at one place pass over them.
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

// Shots come and go at random. Each group reaches what its shots reach, and none is too large.
TEST_F(GroupsTest, HoldWhatTheirShotsReach) {
  Groups groups;
  std::vector<CellReach> shots;
  const auto check = [&] {
    size_t at = 0;
    for (size_t i = 0; i < groups.size(); ++i) {
      const Groups::Group& group = groups[i];
      EXPECT_GT(group.count, 0u);
      EXPECT_LE(group.count, Groups::kMost);
      for (const size_t end = at + group.count; at < end; ++at) {
        ASSERT_LT(at, shots.size());
        CellReach both = group.reach;
        both |= shots[at];
        EXPECT_EQ(both.parts, group.reach.parts);
        EXPECT_EQ(both.squares.rows, group.reach.squares.rows);
      }
    }
    EXPECT_EQ(at, shots.size());
  };
  for (int i = 0; i < 3000; ++i) {
    const size_t at = i % 3 == 0 ? 0 : i % 3 == 1 ? shots.size() : random_() % (shots.size() + 1);
    const CellReach reach = reachOf(uint64_t{1} << random_() % 64, 1, point(), direction(), 0.2f);
    groups.insert(at, reach);
    shots.insert(shots.begin() + static_cast<std::ptrdiff_t>(at), reach);
    if (i % 7 == 0) {
      const size_t which = random_() % shots.size();
      groups.extend(which, {.parts = 3, .squares = {}});
      shots[which].parts |= 3;
    }
    if (i % 100 != 0) continue;
    Groups::Eraser eraser(groups);
    const size_t share = random_() % 5;
    std::erase_if(shots, [&](const CellReach&) {
      const bool erased = random_() % 4 < share;
      eraser.next(erased);
      return erased;
    });
    eraser.finish();
    check();
  }
}

// Of a group whose shots have all gone, nothing stays.
TEST_F(GroupsTest, ForgetShotsThatAreGone) {
  Groups groups;
  for (size_t i = 0; i < 3 * Groups::kMost; ++i) {
    groups.insert(i, {.parts = uint64_t{1} << i / Groups::kMost, .squares = {}});
  }
  Groups::Eraser eraser(groups);
  for (size_t i = 0; i < 3 * Groups::kMost; ++i) eraser.next(i < 2 * Groups::kMost);
  eraser.finish();
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].reach.parts, 4u);
  EXPECT_EQ(groups[0].count, Groups::kMost);
}

// Groups are full where shots come at the ends, newest or oldest first.
TEST_F(GroupsTest, AreFullAtBothEnds) {
  Groups first, last;
  for (size_t i = 0; i < 20 * Groups::kMost; ++i) {
    first.insert(0, {});
    last.insert(i, {});
  }
  EXPECT_EQ(first.size(), 20u);
  EXPECT_EQ(last.size(), 20u);
}

}  // namespace
}  // namespace grisaille::tests
