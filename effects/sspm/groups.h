// SPDX-License-Identifier: MIT
// Groups of up to 16 shots in a cell's list, and what they reach. A pixel that a group does not
// reach passes over it with one test: around a place at which many shots were fired, it need not
// ask each of them.
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

// Some parts and all squares, which takes less time to find.
CellReach wideReachOf(uint64_t parts);

// The groups of a list, in its order.
class Groups {
 public:
  static constexpr uint32_t kMost = 16;  // shots

  struct Group {
    CellReach reach;  // of all its shots
    uint32_t count = 0;
  };

  // A shot is inserted at an index. Divides a full group.
  void insert(size_t at, const CellReach& reach);
  // The shot at an index reaches more.
  void extend(size_t at, const CellReach& reach);
  void clear() { *this = {}; }

  // Erases shots. What the groups of the others reach does not shrink.
  class Eraser {
   public:
    explicit Eraser(Groups& groups) : groups_(groups) {}
    // Call it once for each shot, in order.
    void next(bool erased);
    // Call it at the end.
    void finish() { groups_.merge(); }

   private:
    Groups& groups_;
    size_t next_ = 0;    // group
    uint32_t left_ = 0;  // shots of the group before
  };

  size_t size() const { return groups_.size(); }
  const Group& operator[](size_t i) const { return groups_[i]; }
  size_t bytes() const { return groups_.capacity() * sizeof(Group); }

 private:
  size_t find(size_t& at) const;
  void merge();

  Packed<Group> groups_;
};

}  // namespace grisaille::sspm
