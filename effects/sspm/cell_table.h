// SPDX-License-Identifier: MIT
// The cells of the world where paint lies, and for each a list of the shots that reach it, newest
// first: a hash table with linear probing that shaders/sspm/surface.comp reads.
#pragma once

#include <bitset>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <vector>

#include "mirror.h"

namespace grisaille::sspm {

// A cube of the world, for surfaces that face one of six ways.
struct CellKey {
  glm::ivec3 cell = glm::ivec3(0);  // times the level's edge: its lower corner, metres
  int32_t code = 0;                 // levelCode() + facing

  bool operator==(const CellKey&) const = default;
};

// Cells of a level are 2^exponent metres wide, exponent from -40 to 40.
constexpr int32_t levelCode(int32_t exponent) {
  return (exponent + 40) * 8;
}
constexpr int32_t exponentOf(int32_t code) {
  return code / 8 - 40;
}

// 0 ... 5: the axis that a normal is nearest to, x, y, z, and its sign.
int32_t facingOf(const glm::vec3& normal);

uint32_t hashOf(const CellKey& key);

// A piece of a surface in a cell: about as much of it as one part of the cell holds.
struct KnownPoint {
  uint32_t place = 0;   // in the cell, 10 bits an axis
  uint32_t normal = 0;  // glm::packSnorm3x10_1x2
};

constexpr size_t kMostKnown = 128;  // in a cell
using KnownSet = std::bitset<kMostKnown>;

// A shot in a cell's list.
struct Entry {
  uint32_t shot = 0;
  uint32_t record = 0;    // on the device
  uint32_t word = 0;      // of its map: a plane where the map is that plane all over the cell
  uint64_t touched = 0;   // parts of the cell where it may paint
  uint64_t ragged = 0;    // of these: where it may leave gaps
  KnownSet painted = {};  // known pieces that it may paint: all of each, but for ragged parts
};

struct Cell {
  CellKey key;
  std::vector<Entry> entries;     // newest first
  std::vector<KnownPoint> known;  // one a part and surface
  uint64_t crowded = 0;           // parts with too many surfaces to know them all
  // Pieces where nothing shows of shots older than `sealedBelow`, since newer ones, the newest of
  // them `sealer`, hide it.
  KnownSet sealed = {};
  uint32_t sealedBelow = 0;
  uint32_t sealer = 0;
  uint32_t pruneAt = 0;  // at so many entries it is worth while to look for hidden ones
  uint32_t slot = 0;
  uint32_t first = 0;     // of its run of entries on the device
  uint32_t capacity = 0;  // of that run; 0: none
};

class CellTable {
 public:
  CellTable() : slots_("cells"), words_("lists"), runs_(words_, 4) { clear(); }

  void clear();

  // The cell, made where it is not there. The reference is good until the next call.
  Cell& at(const CellKey& key);
  Cell* find(const CellKey& key);

  // To be called when a cell's entries have changed: renews what the device reads.
  void publish(Cell& cell);

  std::deque<Cell>& cells() { return cells_; }
  uint32_t slotMask() const { return static_cast<uint32_t>(slotCells_.size() - 1); }

  Mirror& slots() { return slots_; }
  Mirror& words() { return words_; }

 private:
  void place(uint32_t cell);
  void grow();

  std::deque<Cell> cells_;           // a deque grows without moving
  std::vector<uint32_t> slotCells_;  // index of the cell; ~0: free
  Mirror slots_, words_;
  Runs runs_;
};

}  // namespace grisaille::sspm
