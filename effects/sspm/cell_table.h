// SPDX-License-Identifier: MIT
// Hash grid of the world: for each cell with paint, the list of shots that reach it, newest first.
// A hash table with linear probing, which shaders/sspm/walk.glsl reads.
#pragma once

#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "device_words.h"
#include "groups.h"
#include "packed.h"

namespace grisaille::sspm {

// Key of a cell: a cube of the world, and one of six facings of the surfaces in it.
struct CellKey {
  glm::ivec3 cell = glm::ivec3(0);  // lower corner, in cells of the level
  int32_t code = 0;                 // levelCode() + facing

  bool operator==(const CellKey&) const = default;
};

// A level has cells of 2^exponent metres, exponent from -40 to 40.
constexpr int32_t levelCode(int32_t exponent) {
  return (exponent + 40) * 8;
}
constexpr int32_t exponentOf(int32_t code) {
  return code / 8 - 40;
}

// Axis of a key's facing, 0 to 2.
constexpr int axisOf(int32_t code) {
  return code % 8 / 2;
}

// Facing of a normal, 0 ... 5: twice the index of its largest component, plus 1 if that is
// negative.
int32_t facingOf(const glm::vec3& normal);

uint32_t hashOf(const CellKey& key);

// A piece of a surface in a cell, about as large as one of the cell's 4x4x4 parts.
struct KnownPoint {
  uint32_t place : 30 = 0;   // position in the cell, 10 bits per axis
  uint32_t covered : 1 = 0;  // newer paint covers all its spots: see Cell::coveredBelow
  uint32_t normal = 0;       // glm::packSnorm3x10_1x2
};

constexpr size_t kMostKnown = 512;  // pieces in a cell
constexpr size_t kMostSealed = 64;  // of these, that can be sealed: the first

// A shot in a cell's list.
struct Entry {
  uint64_t touched = 0;  // parts of the cell that it may paint
  uint64_t solid = 0;    // of the first kMostSealed known pieces: those that it paints without gaps
  uint32_t shot = 0;
  // Reference within its map: the root, or a plane if that plane serves the whole cell.
  uint16_t reference = 0;
  // Whether its surfaces pass through the cell. Otherwise they only come close, and the entry stays
  // as long as the shot has entries in other cells.
  bool core = false;
  // Whether it is of the shot as it was placed before: see former.cpp.
  bool former = false;
};

struct Cell {
  CellKey key;
  Packed<Entry> entries;     // newest first; insert() and eraseIf() of the cell change it
  Groups groups;             // of `entries`
  Packed<KnownPoint> known;  // one per part and surface
  uint64_t crowded = 0;      // parts with surfaces that did not fit into `known`
  // Sealed pieces: newer shots hide every shot older than `sealedBelow` on them. `sealer` is the
  // newest of these shots.
  uint64_t sealed = 0;
  uint32_t sealedBelow = 0;
  uint32_t sealer = 0;
  // The same of the pieces that thin() found covered. `coverer` is at least the length of the list
  // before that pass.
  uint32_t coveredBelow = 0;
  uint32_t coverer = 0;
  uint32_t pruneAt = 0;   // number of entries at which the next prune() pays
  uint32_t slot = 0;      // in the hash table
  uint32_t first = 0;     // first unit of its run on the device
  uint32_t capacity = 0;  // units of that run; 0: no run
  uint32_t bytes = 0;     // of its lists, on the host
  uint32_t units = 0;     // that its run on the device will take
  bool changed = false;   // since the last upload
  bool wide = false;      // some groups lack their masks: see former.cpp
  bool fresh = true;      // a shot has come that is not older than `coveredBelow`

  // reach(): of `entry`; called if that is needed.
  template <typename Reach>
  void insert(size_t at, const Entry& entry, const Reach& reach) {
    entries.insert(at, entry);
    groups.insert(at, axisOf(key.code), reach);
  }
  // Returns the number of erased entries. Calls erased() once for each entry, in order.
  template <typename Erased>
  size_t eraseIf(const Erased& erased) {
    Groups::Eraser eraser(groups, axisOf(key.code));
    const size_t count = entries.eraseIf([&](const Entry& entry) {
      const bool isErased = erased(entry);
      eraser.next(isErased);
      return isErased;
    });
    if (count > 0) eraser.finish();
    return count;
  }

  // Forgets what is hidden, because a shot has left the list.
  void unseal() {
    sealed = 0;
    coveredBelow = 0;
    pruneAt = 0;
    fresh = true;
  }
};

class CellTable {
 public:
  CellTable() : slots_("cells"), words_("lists"), runs_(words_, 4) { clear(); }

  void clear();

  // The cell of a key, created if missing. The reference is valid until the next call.
  Cell& at(const CellKey& key);
  // Null if missing.
  Cell* find(const CellKey& key) { return const_cast<Cell*>(std::as_const(*this).find(key)); }
  const Cell* find(const CellKey& key) const;
  // Call it after each change of a cell's entries.
  void change(Cell& cell);
  // Removes the cells without entries.
  void removeEmpty();

  // Writes the changed cells to the arrays.
  // recordOf(entry): index of its shot's record on the device.
  template <typename RecordOf>
  void write(const RecordOf& recordOf) {
    for (const uint32_t index : changed_) {
      Cell& cell = cells_[index];
      cell.changed = false;
      uint32_t* word = reserve(cell).data();
      const Entry* entry = cell.entries.begin();
      const CellReach* mask = cell.groups.masks();
      for (size_t i = 0; i < cell.groups.size(); ++i) {
        const Groups::Group& group = cell.groups[i];
        word = writeBlock(cell.groups, i, mask, word);
        if (group.pays()) word = writeMask(*mask, group.count, word);
        if (group.mayPay()) ++mask;
        for (const Entry* end = entry + group.count; entry != end; ++entry) {
          *word++ = recordOf(*entry);
          *word++ = entry->reference;
          *word++ = static_cast<uint32_t>(entry->touched);
          *word++ = static_cast<uint32_t>(entry->touched >> 32);
        }
      }
    }
    writeSlots();
  }

  std::deque<Cell>& cells() { return cells_; }
  uint32_t slotCount() const { return static_cast<uint32_t>(slotCells_.size()); }
  // Host and device together, also while arrays grow; bytes.
  uint64_t bytes() const;

  DeviceWords& slots() { return slots_; }
  DeviceWords& words() { return words_; }

 private:
  uint32_t slotOf(const CellKey& key) const;
  uint32_t after(uint32_t slot) const { return slot + 1 < slotCount() ? slot + 1 : 0; }
  void place(uint32_t cell);
  void rehash();
  // The cell's run on the device, as long as its list and its masks.
  std::span<uint32_t> reserve(Cell& cell);
  // Writes what groups from `first` on reach together, if a block of them starts there. Returns the
  // word after it.
  // mask: of the first group.
  static uint32_t* writeBlock(const Groups& groups, size_t first, const CellReach* mask,
                              uint32_t* word);
  // Writes what the units after it reach. Returns the word after it.
  static uint32_t* writeMask(const CellReach& mask, size_t units, uint32_t* word);
  void writeSlots();

  std::deque<Cell> cells_;           // a deque: references stay valid
  std::vector<uint32_t> slotCells_;  // index into cells_; ~0: free
  std::vector<uint32_t> changed_;    // indices of changed cells
  bool rehashed_ = false;            // since the last upload
  uint64_t listBytes_ = 0;           // sum of Cell::bytes
  uint64_t units_ = 0;               // sum of Cell::units
  DeviceWords slots_, words_;
  Runs runs_;
};

}  // namespace grisaille::sspm
