// SPDX-License-Identifier: MIT
#include "cell_table.h"

#include <bit>

namespace grisaille::sspm {
namespace {

constexpr uint32_t kFree = ~0u;
constexpr size_t kSlotWords = 6;
constexpr size_t kFirstSlots = 1024;

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
  slotCells_.assign(kFirstSlots, kFree);
  slots_.resize(kFirstSlots * kSlotWords);
  slots_.fill(kFree);
  runs_.clear();
}

Cell* CellTable::find(const CellKey& key) {
  for (uint32_t i = hashOf(key) & slotMask();; i = (i + 1) & slotMask()) {
    const uint32_t cell = slotCells_[i];
    if (cell == kFree) return nullptr;
    if (cells_[cell].key == key) return &cells_[cell];
  }
}

Cell& CellTable::at(const CellKey& key) {
  if (Cell* cell = find(key)) return *cell;
  cells_.emplace_back().key = key;
  if (cells_.size() * 3 > slotCells_.size() * 2) {
    grow();
  } else {
    place(static_cast<uint32_t>(cells_.size() - 1));
  }
  return cells_.back();
}

void CellTable::place(uint32_t cell) {
  uint32_t i = hashOf(cells_[cell].key) & slotMask();
  while (slotCells_[i] != kFree) i = (i + 1) & slotMask();
  slotCells_[i] = cell;
  Cell& placed = cells_[cell];
  placed.slot = i;
  const auto slot = slots_.change(i * kSlotWords, kSlotWords);
  for (int axis = 0; axis < 3; ++axis) {
    slot[static_cast<size_t>(axis)] = static_cast<uint32_t>(placed.key.cell[axis]);
  }
  slot[3] = static_cast<uint32_t>(placed.key.code);
  slot[4] = placed.first;
  slot[5] = static_cast<uint32_t>(placed.entries.size());
}

void CellTable::grow() {
  const size_t count = slotCells_.size() * 2;
  slotCells_.assign(count, kFree);
  slots_.resize(count * kSlotWords);
  slots_.fill(kFree);
  for (uint32_t i = 0; i < cells_.size(); ++i) place(i);
}

std::span<uint32_t> CellTable::reserve(Cell& cell) {
  const uint32_t count = static_cast<uint32_t>(cell.entries.size());
  const uint32_t wanted = count == 0 ? 0 : Runs::capacityFor(count);
  if (wanted != cell.capacity) {
    if (cell.capacity > 0) runs_.give(cell.first, cell.capacity);
    cell.first = count > 0 ? runs_.take(count) : 0;
    cell.capacity = wanted;
  }
  const auto slot = slots_.change(cell.slot * kSlotWords + 4, 2);
  slot[0] = cell.first;
  slot[1] = count;
  return count > 0 ? words_.change(size_t{cell.first} * 4, size_t{count} * 4)
                   : std::span<uint32_t>();
}

}  // namespace grisaille::sspm
