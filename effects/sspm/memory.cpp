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
constexpr uint64_t kReserveShare = 32;    // of the limit
constexpr size_t kSweepCells = 2048;      // at a time

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

// Removes the entries of hidden shots once they are many, and cells without entries: some cells at
// a time. Returns whether more cells are to be swept.
bool PaintWorld::sweep() {
  if (swept_ == 0 && (hidden_ < kSweepAt || hidden_ < entries_ / 8)) return false;
  auto& cells = cells_.cells();
  const size_t end = std::min(swept_ + kSweepCells, cells.size());
  for (; swept_ < end; ++swept_) {
    Cell& cell = cells[swept_];
    const auto erased = cell.entries.eraseIf([&](const Entry& entry) {
      if (!isGone(entry)) return false;
      unlist(entry, 0);
      return true;
    });
    if (erased > 0) cells_.change(cell);
  }
  if (swept_ < cells.size()) return true;
  swept_ = 0;
  const auto empty =
      std::ranges::count_if(cells, [](const Cell& it) { return it.entries.empty(); });
  if (static_cast<size_t>(empty) > cells.size() / 8) cells_.removeEmpty();
  return false;
}

// Host and device together, also while arrays grow.
uint64_t PaintWorld::bytes() const {
  uint64_t sum = cells_.bytes() + records_.peakBytes() + blocks_.peakBytes() + kWorkBytes;
  sum += placed_.capacity() * sizeof(Placed) + states_.size() * sizeof(State) +
         pending_.capacity() * sizeof(uint32_t) + twins_.size() * kTwinBytes;
  if (looks_) sum += kMostLooks * Muzzle::kBytes;
  for (const Work& work : partly_) sum += work.survey.bytes() + work.cells.size() * sizeof(CellKey);
  return sum;
}

// Gives up the oldest shots until the rest fits: first those that are not placed and older than
// all that are, then the oldest tenth.
void PaintWorld::keepWithin() {
  const uint64_t limit = limit_ - (reserves_ ? limit_ / kReserveShare : 0);
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
  if (floors_.empty() || floors_.back().shots < states_.size()) {
    floors_.push_back({.shots = states_.size(), .before = floor_});
  }
  floor_ = floor;
}

// Puts those shots back to pending that were not given up before the list was longer than `shots`.
void PaintWorld::takeUp(size_t shots) {
  uint32_t floor = floor_;
  for (; !floors_.empty() && floors_.back().shots > shots; floors_.pop_back()) {
    floor = floors_.back().before;
  }
  const uint32_t end =
      std::min(std::exchange(floor_, floor), static_cast<uint32_t>(states_.size()));
  floor_ = std::min(floor_, end);
  std::vector<uint32_t> ids(end - floor_);
  std::iota(ids.begin(), ids.end(), floor_);
  pending_.insert(pending_.begin(), ids.begin(), ids.end());
}

}  // namespace grisaille::sspm
