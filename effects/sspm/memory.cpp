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
constexpr uint64_t kRoomShare = 64;       // of the limit: free space for the maps of the next shots
constexpr uint64_t kSpareShare = 16;      // of the limit: paint gets coarser before that is left
constexpr uint64_t kFullShare = 32;       // of the limit: paint is about to go before that is left
constexpr uint64_t kPlanShare = 4;        // of the limit: when the array of maps is planned
constexpr uint64_t kMoveShare = 8;        // of the limit: growth while an array moves
constexpr double kMapsLeft = 0.42;        // of maps, once all but the newest quarter are coarse
constexpr double kListsLeft = 1.25;       // of lists, with the copies that they need to grow
constexpr double kListsPlanned = 0.65;    // of lists on the device: cells have more shots each

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
  // A former one is about to be surveyed again, whatever hides its old place.
  if (!entry.former) states_[entry.shot].lostTo = std::max(states_[entry.shot].lostTo, to);
  --entries_;
  const uint32_t record = recordOf(entry);
  Placed& placed = placed_[record];
  --(entry.core && !placed.hidden ? placed.cores : placed.others);
  if (placed.hidden) --hidden_;
  if (record != placing_) release(record);
}

// Frees what a shot does not need any more: its map without cores, its record without entries.
void PaintWorld::release(uint32_t record) {
  Placed& placed = placed_[record];
  if (placed.cores > 0) return;
  coarse_ -= placed.isCoarse() ? 1 : 0;
  give(placed.exact);
  give(placed.coarse);
  if (placed.others == 0) {
    slotOf(record) = kNone;
    freeRecords_.push_back(record);
    placed.hidden = false;
  } else if (!placed.hidden) {
    placed.hidden = true;
    hidden_ += placed.others;
    writeRecord(record);
  }
}

// Hides a placed shot: it paints nothing any more.
void PaintWorld::hide(uint32_t record) {
  Placed& placed = placed_[record];
  placed.others += std::exchange(placed.cores, 0);
  release(record);
}

// Whether an entry is of a hidden shot.
bool PaintWorld::isGone(const Entry& entry) const {
  const uint32_t record = recordOf(entry);
  return record != kNone && placed_[record].hidden;
}

// Removes the entries of hidden shots once they are many or the last of former_, and cells without
// entries: some cells at a time. Returns whether more cells are to be swept.
bool PaintWorld::sweep() {
  const bool ends = !former_.empty() && isSettled();
  if (swept_ == 0) {
    if (!ends && (hidden_ < kSweepAt || hidden_ < entries_ / 8)) return false;
    lastSweep_ = ends;
  }
  auto& cells = cells_.cells();
  const size_t end = std::min(swept_ + kSweepCells, cells.size());
  for (; swept_ < end; ++swept_) sweepCell(cells[swept_]);
  if (swept_ < cells.size()) return true;
  swept_ = 0;
  const auto empty =
      std::ranges::count_if(cells, [](const Cell& it) { return it.entries.empty(); });
  if (lastSweep_ && ends) {
    dropFormer();
  } else if (static_cast<size_t>(empty) > cells.size() / 8 && !thinning_.isActive()) {
    cells_.removeEmpty();
  }
  return ends && !former_.empty();
}

void PaintWorld::sweepCell(Cell& cell) {
  const auto erased = cell.eraseIf([&](const Entry& entry) {
    if (!isGone(entry)) return false;
    unlist(entry, 0);
    return true;
  });
  if (erased > 0) cells_.change(cell);
}

// Host and device together, also while arrays grow.
uint64_t PaintWorld::bytes() const {
  uint64_t sum =
      cells_.bytes() + records_.peakBytes() + blocks_.peakBytes() + runs_.bytes() + kWorkBytes;
  sum += placed_.capacity() * sizeof(Placed) + states_.size() * sizeof(State) +
         (pending_.capacity() + former_.capacity()) * sizeof(uint32_t) + twins_.size() * kTwinBytes;
  sum += thinning_.bytes();
  if (looks_) sum += kMostLooks * Muzzle::kBytes;
  for (const Work& work : partly_) sum += work.survey.bytes() + work.cells.size() * sizeof(CellKey);
  return sum;
}

// Writes a map on the device.
PaintWorld::MapRun PaintWorld::store(const ShotMap& map) {
  MapRun run{.base = 0, .blocks = static_cast<uint32_t>(map.words.size() / 2), .root = map.root};
  if (run.blocks == 0) return run;
  run.base = runs_.take(run.blocks);
  std::ranges::copy(map.words, blocks_.write(size_t{run.base} * 2, map.words.size()).begin());
  return run;
}

void PaintWorld::give(MapRun& run) {
  if (run.blocks > 0) {
    blocks_.drop(size_t{run.base} * 2);
    runs_.give(run.base, run.blocks);
  }
  run = {};
}

// Most memory at present: new shots leave some to the next undo.
uint64_t PaintWorld::room() const {
  return limit_ - (reserves_ ? limit_ / kReserveShare : 0);
}

// Whether the maps of the next shots need a larger array than the limit allows.
// spare: part of the limit that stays free; bytes.
bool PaintWorld::areMapsFull(uint64_t spare) const {
  const uint64_t wanted = reserves_ ? limit_ / kRoomShare : 0;
  const uint64_t space = runs_.freeWords() * sizeof(uint32_t);
  if (space >= wanted) return false;
  const uint64_t larger = blocks_.capacity() + (wanted - space) / sizeof(uint32_t);
  const uint64_t grown = bytes() - blocks_.peakBytes() + blocks_.peakBytes(larger);
  return grown + spare > room();
}

// Whether a map fits into the free spaces of the array, or the limit allows a larger array. Free
// space may be in pieces that are too small.
bool PaintWorld::fits(const ShotMap& map) const {
  if (runs_.fits(static_cast<uint32_t>(map.words.size() / 2))) return true;
  const uint64_t larger = blocks_.capacity() + map.words.size();
  return bytes() - blocks_.peakBytes() + blocks_.peakBytes(larger) <= room();
}

// Whether paint will go soon, unless it gets coarser.
bool PaintWorld::isScarce() const {
  return areMapsFull(limit_ / kSpareShare) || bytes() > room() - room() / kSpareShare;
}

// Whether paint is about to go.
bool PaintWorld::isFull() const {
  return lacks_ == Lacks::kCoarse || areMapsFull(0) || bytes() > room() - room() / kFullShare;
}

// Near the limit there is no room for the old array of maps beside a larger one. So it grows early,
// to the share of the limit that maps will have beside the lists. The array of lists grows with it,
// as much: no later frame has to wait for its copy.
void PaintWorld::planArrays() {
  if (plannedFor_ == limit_) return;
  const uint64_t space = limit_ - std::min(limit_, kWorkBytes), all = bytes() - kWorkBytes;
  if (all < space / kPlanShare) return;
  plannedFor_ = limit_;
  const uint64_t mapBytes = blocks_.peakBytes();
  const double maps = kMapsLeft * static_cast<double>(mapBytes);
  const double lists = kListsLeft * static_cast<double>(all - std::min(all, mapBytes));
  // The larger array and this one must fit until all is moved.
  const uint64_t most = room() - std::min(room(), bytes() + limit_ / kMoveShare);
  const double planned =
      std::min(static_cast<double>(space) * maps / (maps + lists), static_cast<double>(most));
  blocks_.plan(static_cast<uint64_t>(planned) / sizeof(uint32_t));
  const double growth = planned / std::max(maps, 1.0);
  for (DeviceWords* words : {&cells_.words(), &records_}) {
    words->plan(static_cast<uint64_t>(growth * kListsPlanned * static_cast<double>(words->size())));
  }
}

// Makes room for the maps of the next shots: the oldest get coarser.
void PaintWorld::makeRoom() {
  planArrays();
  if (lacks_ != Lacks::kNothing && coarsen()) lacks_ = Lacks::kNothing;
  while (areMapsFull(limit_ / kSpareShare) && coarsen()) continue;
}

// Keeps the memory below the limit. Where coarser maps are not enough, or lists are too many, the
// oldest shots go; but a pass that may find hidden ones comes first.
void PaintWorld::keepWithin() {
  makeRoom();
  const bool waits = thinning_.isActive() || isThinningDue();
  if (lacks_ == Lacks::kCoarse && !waits) giveUpOldest();
  lacks_ = Lacks::kNothing;
  while (!waits && areMapsFull(0) && giveUpOldest()) continue;
  while (bytes() > room() && giveUpOldest()) continue;
}

// Gives up the exact maps of the oldest tenth of the shots with exact maps, but none of the newest
// quarter. Returns false if there are none.
bool PaintWorld::coarsen() {
  const auto hasBoth = [](const Placed& placed) {
    return placed.cores > 0 && placed.exact.blocks > 0 && placed.coarse.blocks > 0;
  };
  std::vector<uint32_t> all, exact;
  for (const Placed& placed : placed_) {
    if (placed.cores == 0) continue;
    all.push_back(placed.shot);
    if (hasBoth(placed)) exact.push_back(placed.shot);
  }
  if (exact.empty()) return false;
  const auto newest = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 3 / 4);
  std::ranges::nth_element(all, newest);
  const auto tenth = exact.begin() + static_cast<std::ptrdiff_t>(exact.size() / 10);
  std::ranges::nth_element(exact, tenth);
  const uint32_t below = std::min(*tenth + 1, *newest);
  if (std::ranges::none_of(exact, [&](uint32_t id) { return id < below; })) return false;
  noteFloors();
  floors_.coarse = std::max(floors_.coarse, below);
  for (uint32_t record = 0; record < placed_.size(); ++record) {
    Placed& placed = placed_[record];
    if (!hasBoth(placed) || placed.shot >= below) continue;
    give(placed.exact);
    ++coarse_;
    writeRecord(record);
  }
  // Shots that were to get their exact maps back stay coarse.
  const auto stays = [&](uint32_t id) { return id < below && isPlaced(id); };
  std::erase_if(pending_, stays);
  std::erase_if(work_, [&](const Work& work) { return stays(work.id); });
  return true;
}

// Gives up the oldest shots: first those that are not placed and older than all that are, then the
// oldest tenth. Returns false if none is placed.
bool PaintWorld::giveUpOldest() {
  std::vector<uint32_t> ids;
  for (const Placed& placed : placed_) {
    if (placed.cores > 0) ids.push_back(placed.shot);
  }
  if (ids.empty()) return false;
  const uint32_t oldest = *std::ranges::min_element(ids);
  uint32_t floor = oldest;
  if (pending_.empty() || pending_.front() >= oldest) {
    const auto tenth = ids.begin() + static_cast<std::ptrdiff_t>(ids.size() / 10);
    std::ranges::nth_element(ids, tenth);
    floor = *tenth + 1;
  }
  giveUp(floor);
  return true;
}

// Notes the floors before the list of this length raises them.
void PaintWorld::noteFloors() {
  if (raises_.empty() || raises_.back().shots < states_.size()) {
    raises_.push_back({.shots = states_.size(), .before = floors_});
  }
}

// Gives up all shots below `floor`.
void PaintWorld::giveUp(uint32_t floor) {
  std::vector<bool> gone(states_.size());
  std::fill_n(gone.begin(), floor, true);
  forgetTwins(gone, floor);
  erase(gone);
  noteFloors();
  floors_.given = floor;
}

// Lowers the floors to those before the list was longer than `shots`. Shots that were given up are
// pending then, and coarse ones too, which stay placed until their exact maps are complete. Those
// that were surveyed for the coarse map alone are placed anew, because their lists have gaps where
// details are small. So are all hidden shots then: one of those may have hidden them.
void PaintWorld::takeUp(size_t shots) {
  const Floors from = floors_;
  for (; !raises_.empty() && raises_.back().shots > shots; raises_.pop_back()) {
    floors_ = raises_.back().before;
  }
  const auto count = static_cast<uint32_t>(states_.size());
  for (uint32_t id = floors_.given = std::min(floors_.given, count);
       id < std::min(from.given, count); ++id) {
    if (!isLost(id)) pending_.push_back(id);
  }
  floors_.coarse = std::min(floors_.coarse, count);
  std::erase_if(work_, [&](const Work& work) {
    if (!work.survey.isCoarse() || work.id < floors_.coarse) return false;
    pending_.push_back(work.id);
    return true;
  });
  const auto isAtWork = [&](uint32_t id) {
    return std::ranges::any_of(work_, [&](const Work& work) { return work.id == id; });
  };
  bool isRough = false;
  std::vector<bool> anew(count);
  for (const Placed& placed : placed_) {
    const uint32_t id = placed.shot;
    if (placed.cores == 0 || !placed.isCoarse() || id < floors_.coarse || isAtWork(id)) continue;
    if (states_[id].exact) {
      pending_.push_back(id);
    } else {
      anew[id] = isRough = true;
    }
  }
  if (isRough) {
    for (uint32_t id = 0; id < count; ++id) anew[id] = anew[id] || isLost(id);
    forgetTwins(anew, count);
    placeAnew(anew, count);
  }
  sortPending();
}

}  // namespace grisaille::sspm
