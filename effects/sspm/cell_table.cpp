// SPDX-License-Identifier: MIT
#include "cell_table.h"

#include <algorithm>
#include <utility>

namespace grisaille::sspm {
namespace {

constexpr uint32_t kFree = ~0u;
constexpr size_t kSlotWords = 6;
// A list on the device consists of units: one per entry, and five before each group and each
// block.
constexpr size_t kUnitWords = 4, kReachUnits = 5;
constexpr size_t kBlockGroups = 16;  // groups in a block
constexpr size_t kFirstSlots = 1024;

// A block of one group needs no units of its own.
bool isBlock(const Groups& groups, size_t first) {
  return first % kBlockGroups == 0 && groups.size() - first > 1;
}

uint32_t unitsOf(const Cell& cell) {
  const size_t groups = cell.groups.size();
  const size_t blocks = (groups + kBlockGroups - 2) / kBlockGroups;
  return static_cast<uint32_t>(cell.entries.size() + kReachUnits * (groups + blocks));
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
  return listBytes_ + runs_.bytes() + cells_.size() * (sizeof(Cell) + 3 * 16) +
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

uint32_t* CellTable::writeBlock(const Groups& groups, size_t first, uint32_t* word) {
  if (!isBlock(groups, first)) return word;
  CellReach reach;
  size_t units = 0;
  for (size_t i = first; i < std::min(first + kBlockGroups, groups.size()); ++i) {
    reach |= groups[i].reach;
    units += kReachUnits + groups[i].count;
  }
  return writeReach(reach, 0, static_cast<uint32_t>(units), word);
}

uint32_t* CellTable::writeReach(const CellReach& reach, uint32_t entries, uint32_t units,
                                uint32_t* word) {
  for (size_t row = 0; row < reach.squares.rows.size(); row += 2) {
    *word++ = reach.squares.rows[row] | uint32_t{reach.squares.rows[row + 1]} << 16;
  }
  *word++ = static_cast<uint32_t>(reach.parts);
  *word++ = static_cast<uint32_t>(reach.parts >> 32);
  *word++ = entries;
  *word++ = units;
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
