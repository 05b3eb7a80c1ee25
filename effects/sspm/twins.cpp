// SPDX-License-Identifier: MIT
// Twins: shots of one ray and range. Only the newest is placed; it counts the others.
#include <algorithm>

#include "paint_world.h"

namespace grisaille::sspm {

// If a newer twin is placed, it counts this shot.
bool PaintWorld::countTwin(uint32_t id) {
  const auto found = twins_.find(twinHash(list_[id]));
  if (found == twins_.end()) return false;
  Twins& twins = found->second;
  if (twins.newest < id || !areTwins(list_[twins.newest], list_[id])) return false;
  states_[id].lostTo = twins.newest + 1;
  writeCount(twins.newest, ++twins.counted);
  return true;
}

// A placed shot replaces the older twin that was placed before it.
// cells: those of both.
void PaintWorld::joinTwins(uint32_t id, std::span<const CellKey> cells) {
  const auto [found, added] = twins_.try_emplace(twinHash(list_[id]), Twins{.newest = id});
  Twins& twins = found->second;
  if (!added && !areTwins(list_[twins.newest], list_[id])) return;
  if (twins.newest != id) {
    const uint32_t older = std::exchange(twins.newest, id);
    remove(older, cells);
    states_[older].lostTo = std::max(states_[older].lostTo, id + 1);
    ++twins.counted;
  }
  writeCount(id, twins.counted);
}

// Removes shots from their groups that are gone, or are to be placed anew. Where the newest is, the
// others are too, to be counted again.
// count: number of leading shots of the list that have not changed.
void PaintWorld::forgetTwins(std::vector<bool>& gone, size_t count) {
  for (uint32_t id = 0; id < count; ++id) {
    if (!gone[id] || states_[id].lostTo == 0) continue;
    const auto found = twins_.find(twinHash(list_[id]));
    if (found == twins_.end()) continue;
    Twins& twins = found->second;
    if (twins.newest == id || gone[twins.newest] || !areTwins(list_[twins.newest], list_[id])) {
      continue;
    }
    writeCount(twins.newest, --twins.counted);
  }
  std::vector<uint64_t> again;
  std::erase_if(twins_, [&](const auto& entry) {
    const Twins& twins = entry.second;
    if (gone[twins.newest] && twins.counted > 0) again.push_back(entry.first);
    return static_cast<bool>(gone[twins.newest]);
  });
  if (again.empty()) return;
  std::ranges::sort(again);
  for (uint32_t id = 0; id < count; ++id) {
    if (states_[id].record == kNone && std::ranges::binary_search(again, twinHash(list_[id]))) {
      gone[id] = true;
    }
  }
}

void PaintWorld::writeCount(uint32_t id, uint32_t counted) {
  const uint32_t record = states_[id].record;
  if (record == kNone) return;
  placed_[record].counted = counted;
  writeRecord(record);
}

}  // namespace grisaille::sspm
