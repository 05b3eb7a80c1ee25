// SPDX-License-Identifier: MIT
// Records and maps of placed shots, and the limit of memory.
#include <algorithm>
#include <numeric>
#include <utility>

#include "paint_world.h"

namespace grisaille::sspm {
namespace {

constexpr size_t kTwinBytes = 128;        // of a group of twins, with its node in the hash table
constexpr uint64_t kWorkBytes = 4 << 20;  // of the surveys in work_
constexpr size_t kSweepAt = 4096;         // entries of hidden shots

}  // namespace

uint32_t PaintWorld::takeRecord(uint32_t id) {
  if (freeRecords_.empty()) {
    freeRecords_.push_back(static_cast<uint32_t>(placed_.size()));
    placed_.emplace_back();
    records_.resize(placed_.size() * kRecordWords);
  }
  const uint32_t record = freeRecords_.back();
  freeRecords_.pop_back();
  placed_[record] = {.shot = id};
  states_[id].record = record;
  return record;
}

// A cell has removed an entry, because shot `to` - 1 hides it (0: another reason).
void PaintWorld::unlist(const Entry& entry, uint32_t to) {
  State& state = states_[entry.shot];
  state.lostTo = std::max(state.lostTo, to);
  --entries_;
  Placed& placed = placed_[state.record];
  --(entry.core ? placed.cores : placed.others);
  if (placed.hidden) --hidden_;
  if (state.record != placing_) release(state.record);
}

// Frees what a shot does not need any more: its map without cores, its record without entries.
void PaintWorld::release(uint32_t record) {
  Placed& placed = placed_[record];
  if (placed.cores > 0) return;
  if (placed.blocks > 0) runs_.give(placed.base, placed.blocks);
  placed.blocks = 0;
  if (placed.others == 0) {
    states_[placed.shot].record = kNone;
    freeRecords_.push_back(record);
    placed.hidden = false;
  } else if (!placed.hidden) {
    placed.hidden = true;
    hidden_ += placed.others;
    writeRecord(record);
  }
}

// Whether an entry is of a hidden shot.
bool PaintWorld::isGone(const Entry& entry) const {
  const uint32_t record = states_[entry.shot].record;
  return record != kNone && placed_[record].hidden;
}

// Removes the entries of hidden shots once they are many, and cells without entries.
void PaintWorld::sweep() {
  if (hidden_ < kSweepAt || hidden_ < entries_ / 8) return;
  size_t empty = 0;
  for (Cell& cell : cells_.cells()) {
    const auto erased = cell.entries.eraseIf([&](const Entry& entry) {
      if (!isGone(entry)) return false;
      unlist(entry, 0);
      return true;
    });
    if (erased > 0) cells_.change(cell);
    empty += cell.entries.empty() ? 1 : 0;
  }
  if (empty > cells_.cells().size() / 8) cells_.removeEmpty();
}

// Host and device together, also while arrays grow.
uint64_t PaintWorld::bytes() const {
  uint64_t sum = cells_.bytes() + records_.peakBytes() + blocks_.peakBytes() + kWorkBytes;
  sum += placed_.capacity() * sizeof(Placed) + states_.size() * sizeof(State) +
         pending_.capacity() * sizeof(uint32_t) + twins_.size() * kTwinBytes;
  for (const Work& work : partly_) sum += work.survey.bytes() + work.cells.size() * sizeof(CellKey);
  return sum;
}

// Gives up the oldest shots until the rest fits: first those that are not placed and older than
// all that are, then the oldest tenth.
void PaintWorld::keepWithin(uint64_t limit) {
  std::vector<uint32_t> ids;
  while (bytes() > limit) {
    ids.clear();
    for (const Placed& placed : placed_) {
      if (placed.cores > 0) ids.push_back(placed.shot);
    }
    if (ids.empty()) return;
    const uint32_t oldest = *std::ranges::min_element(ids);
    uint32_t floor = oldest;
    if (pending_.empty() || pending_.front() >= oldest) {
      const auto tenth = ids.begin() + static_cast<std::ptrdiff_t>(ids.size() / 10);
      std::ranges::nth_element(ids, tenth);
      floor = *tenth + 1;
    }
    giveUp(floor);
  }
}

// Gives up all shots below `floor`.
void PaintWorld::giveUp(uint32_t floor) {
  std::vector<bool> gone(states_.size());
  std::fill_n(gone.begin(), floor, true);
  forgetTwins(gone, floor);
  erase(gone);
  floor_ = floor;
}

// Puts the shots that were given up back to pending.
void PaintWorld::takeUp() {
  const uint32_t end = std::min(std::exchange(floor_, 0), static_cast<uint32_t>(states_.size()));
  std::vector<uint32_t> ids(end);
  std::iota(ids.begin(), ids.end(), 0);
  pending_.insert(pending_.begin(), ids.begin(), ids.end());
}

}  // namespace grisaille::sspm
