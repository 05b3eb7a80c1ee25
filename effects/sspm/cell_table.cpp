// SPDX-License-Identifier: MIT
#include "cell_table.h"

#include <algorithm>
#include <utility>

namespace grisaille::sspm {
namespace {

constexpr uint32_t kFree = ~0u;
constexpr size_t kSlotWords = 6;
// A list on the device consists of units: one per entry, and five for each mask.
constexpr size_t kUnitWords = 4, kMaskUnits = 5;
constexpr uint32_t kMask = 0x80000000u;  // walk.glsl
constexpr size_t kBlockGroups = 16;      // groups in a block
constexpr size_t kFirstSlots = 1024;

// Number of groups of the block that starts at a group; 0: none does. One group alone needs no
// other mask, and a block with a group that misses little would miss less.
size_t blockAt(const Groups& groups, size_t first) {
  if (first % kBlockGroups != 0) return 0;
  const size_t count = std::min(kBlockGroups, groups.size() - first);
  for (size_t i = first; i < first + count; ++i) {
    if (!groups[i].pays()) return 0;
  }
  return count > 1 ? count : 0;
}

uint32_t unitsOf(const Cell& cell) {
  size_t masks = 0;
  for (size_t i = 0; i < cell.groups.size(); ++i) {
    masks += (cell.groups[i].pays() ? 1 : 0) + (blockAt(cell.groups, i) > 0 ? 1 : 0);
  }
  return static_cast<uint32_t>(cell.entries.size() + kMaskUnits * masks);
}

// Capacity of the run on the device for a cell's list.
uint32_t capacityFor(const Cell& cell) {
  return cell.entries.empty() ? 0 : Runs::capacityFor(unitsOf(cell));
}

}  // namespace

int32_t facingOf(const glm::vec3& normal) {
  const glm::vec3 n = glm::abs(normal);
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  return axis * 2 + (normal[axis] < 0 ? 1 : 0);
}

uint32_t hashOf(const CellKey& key) {
  const glm::uvec3 c(key.cell);
  uint32_t h = c.x * 0x9e3779b1u ^ c.y * 0x85ebca77u ^ c.z * 0xc2b2ae3du ^
               static_cast<uint32_t>(key.code) * 0x27d4eb2fu;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  return h ^ h >> 12;
}

void CellTable::clear() {
  cells_.clear();
  changed_.clear();
  listBytes_ = units_ = 0;
  slots_.clear();
  words_.clear();
  runs_.clear();
  slotCells_.assign(kFirstSlots, kFree);
  rehash();
}

uint64_t CellTable::bytes() const {
  // An allocation takes 16 bytes more than its contents, on average.
  return listBytes_ + runs_.bytes() + cells_.size() * (sizeof(Cell) + 4 * 16) +
         slotCells_.size() * sizeof(uint32_t) + slots_.peakBytes(slotCells_.size() * kSlotWords) +
         words_.peakBytes(units_ * kUnitWords);
}

// The first slot for a key: the hash as a share of all slots.
uint32_t CellTable::slotOf(const CellKey& key) const {
  return static_cast<uint32_t>(uint64_t{hashOf(key)} * slotCells_.size() >> 32);
}

const Cell* CellTable::find(const CellKey& key) const {
  for (uint32_t i = slotOf(key);; i = after(i)) {
    const uint32_t cell = slotCells_[i];
    if (cell == kFree) return nullptr;
    if (cells_[cell].key == key) return &cells_[cell];
  }
}

Cell& CellTable::at(const CellKey& key) {
  if (Cell* cell = find(key)) return *cell;
  cells_.emplace_back().key = key;
  if (cells_.size() * 10 > slotCells_.size() * 7) {
    slotCells_.assign(slotCells_.size() / 2 * 3, kFree);
    rehash();
  } else {
    place(static_cast<uint32_t>(cells_.size() - 1));
  }
  // Searches on the device go past the slots of other cells, with or without entries.
  change(cells_.back());
  return cells_.back();
}

void CellTable::change(Cell& cell) {
  const size_t bytes = cell.entries.capacity() * sizeof(Entry) +
                       cell.known.capacity() * sizeof(KnownPoint) + cell.groups.bytes();
  listBytes_ = listBytes_ + bytes - cell.bytes;
  cell.bytes = static_cast<uint32_t>(bytes);
  const uint32_t units = capacityFor(cell);
  units_ = units_ + units - cell.units;
  cell.units = units;
  if (!std::exchange(cell.changed, true)) changed_.push_back(slotCells_[cell.slot]);
}

void CellTable::place(uint32_t cell) {
  uint32_t i = slotOf(cells_[cell].key);
  while (slotCells_[i] != kFree) i = after(i);
  slotCells_[i] = cell;
  cells_[cell].slot = i;
}

// Places all cells anew; every slot is free.
void CellTable::rehash() {
  rehashed_ = true;
  for (uint32_t i = 0; i < cells_.size(); ++i) place(i);
}

void CellTable::removeEmpty() {
  for (Cell& cell : cells_) {
    if (!cell.entries.empty()) continue;
    if (cell.capacity > 0) runs_.give(cell.first, cell.capacity);
    listBytes_ -= cell.bytes;
    units_ -= cell.units;
  }
  std::erase_if(cells_, [](const Cell& cell) { return cell.entries.empty(); });
  changed_.clear();
  for (uint32_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].changed) changed_.push_back(i);
  }
  std::ranges::fill(slotCells_, kFree);
  rehash();
}

std::span<uint32_t> CellTable::reserve(Cell& cell) {
  const uint32_t units = unitsOf(cell), wanted = capacityFor(cell);
  if (wanted != cell.capacity) {
    if (cell.capacity > 0) runs_.give(cell.first, cell.capacity);
    cell.first = wanted > 0 ? runs_.take(wanted) : 0;
    cell.capacity = wanted;
  }
  return wanted > 0 ? words_.write(cell.first * kUnitWords, units * kUnitWords)
                    : std::span<uint32_t>();
}

uint32_t* CellTable::writeBlock(const Groups& groups, size_t first, const CellReach* mask,
                                uint32_t* word) {
  const size_t count = blockAt(groups, first);
  if (count == 0) return word;
  CellReach all;
  size_t units = 0;
  for (size_t i = first; i < first + count; ++i) {
    all |= *mask++;
    units += kMaskUnits + groups[i].count;
  }
  return writeMask(all, units, word);
}

uint32_t* CellTable::writeMask(const CellReach& mask, size_t units, uint32_t* word) {
  *word++ = kMask | static_cast<uint32_t>(units);
  *word++ = 0;
  *word++ = static_cast<uint32_t>(mask.parts);
  *word++ = static_cast<uint32_t>(mask.parts >> 32);
  for (size_t row = 0; row < mask.squares.rows.size(); row += 2) {
    *word++ = mask.squares.rows[row] | uint32_t{mask.squares.rows[row + 1]} << 16;
  }
  return word;
}

// Writes the slots of the changed cells, or all of them if their places have changed.
void CellTable::writeSlots() {
  const auto write = [](const Cell& cell, std::span<uint32_t> slot) {
    for (int axis = 0; axis < 3; ++axis) {
      slot[static_cast<size_t>(axis)] = static_cast<uint32_t>(cell.key.cell[axis]);
    }
    slot[3] = static_cast<uint32_t>(cell.key.code);
    slot[4] = cell.first;
    slot[5] = cell.entries.empty() ? 0 : unitsOf(cell);
  };
  if (rehashed_) {
    slots_.discard();
    slots_.resize(slotCells_.size() * kSlotWords);
    const std::span<uint32_t> all = slots_.write(0, slots_.size());
    std::ranges::fill(all, kFree);
    for (const Cell& cell : cells_) write(cell, all.subspan(cell.slot * kSlotWords, kSlotWords));
  } else {
    for (const uint32_t index : changed_) {
      write(cells_[index], slots_.write(cells_[index].slot * kSlotWords, kSlotWords));
    }
  }
  rehashed_ = false;
  changed_.clear();
}

}  // namespace grisaille::sspm
