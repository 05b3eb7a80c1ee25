// SPDX-License-Identifier: MIT
// Groups of up to 16 shots in a cell's list, and masks of what they reach. A pixel that a group
// does not reach passes over it with one test: around a place at which many shots were fired, it
// need not ask each of them. A mask takes as much memory as four shots in a list. A group has one
// only where it lets pixels pass over kSpared shots.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "packed.h"

namespace grisaille::sspm {

// Mask of squares: across its facing's axis `a`, a cell's near and far halves are cut into 16x16.
// Bit b of a row is the square b along axis (a + 1) % 3; rows lie along axis (a + 2) % 3, those of
// the far half after those of the near one.
struct Squares {
  static constexpr int kAWay = 16;

  std::array<uint16_t, 2 * kAWay> rows = {};
};

// What a shot reaches in a cell.
struct CellReach {
  uint64_t parts = 0;  // of its 4x4x4 parts, as in Entry::touched
  Squares squares;

  CellReach& operator|=(const CellReach& other);
};

// What a shot's cylinder reaches of some parts, and not much more.
// axis: of the cell's facing, 0 to 2. muzzle: from the cell's lower corner. direction: unit. range:
// of the shot. Both lengths in cells.
CellReach reachOf(uint64_t parts, int axis, const glm::vec3& muzzle, const glm::vec3& direction,
                  float range);

// The groups of a list, in its order.
class Groups {
 public:
  static constexpr uint32_t kMost = 16;  // shots
  // Shots that a pixel in their parts passes over, on average, if a mask pays.
  static constexpr uint32_t kSpared = 2;
  static constexpr uint32_t kWhole = 256;  // of shares

  struct Group {
    uint16_t count = 0;  // of shots
    // Share of the squares of its shots' parts that none of them reaches.
    uint16_t missed = kWhole;

    // Whether its mask pays.
    bool pays() const { return uint32_t{missed} * count >= kSpared * kWhole; }
    // Whether its mask will pay once it is full, if its shots reach no more.
    bool mayPay() const { return uint32_t{missed} * kMost >= kSpared * kWhole; }
  };

  // A shot is inserted at an index. Divides a full group.
  // axis: of the cell's facing, 0 to 2. reach(): what the shot reaches; called if that is needed.
  template <typename Reach>
  void insert(size_t at, int axis, const Reach& reach) {
    const size_t group = makeRoom(at);
    ++groups_[group].count;
    if (groups_[group].mayPay()) extendGroup(group, axis, reach());
  }
  // The shot at an index reaches more.
  template <typename Reach>
  void extend(size_t at, int axis, const Reach& reach) {
    const size_t group = find(at);
    if (groups_[group].mayPay()) extendGroup(group, axis, reach());
  }
  // The shot at an index may reach all: its group has no mask any more.
  void widen(size_t at);
  void clear() { *this = {}; }

  // Erases shots. What the groups of the others reach does not shrink.
  class Eraser {
   public:
    Eraser(Groups& groups, int axis) : groups_(groups), axis_(axis) {}
    // Call it once for each shot, in order.
    void next(bool erased);
    // Call it at the end.
    void finish() { groups_.merge(axis_); }

   private:
    Groups& groups_;
    int axis_;
    size_t next_ = 0;    // group
    uint32_t left_ = 0;  // shots of the group before
  };

  size_t size() const { return groups_.size(); }
  const Group& operator[](size_t i) const { return groups_[i]; }
  // What the shots of each group that may pay reach together, in their order.
  const CellReach* masks() const { return masks_.begin(); }
  size_t bytes() const {
    return groups_.capacity() * sizeof(Group) + masks_.capacity() * sizeof(CellReach);
  }

 private:
  size_t find(size_t& at) const;
  size_t makeRoom(size_t at);
  size_t maskOf(size_t group) const;
  void insertGroup(size_t group, const Group& inserted, const CellReach& mask);
  void extendGroup(size_t group, int axis, const CellReach& reach);
  void dropMask(size_t group);
  void merge(int axis);

  Packed<Group> groups_;
  Packed<CellReach> masks_;
};

}  // namespace grisaille::sspm
