// SPDX-License-Identifier: MIT
// Where memory gets scarce, finds hidden shots by samples. prune() hides only what newer paint
// covers in the worst case: near edges and over bent surfaces, that is little. A pass looks at 4x4
// spots of each known piece of a surface instead. It sums up the strengths of the shots that see
// a spot, newest first, until the sum is 1. Shots that add nothing at any spot are hidden from then
// on. A piece with no other spots is covered: older shots leave the cell's list, and those that are
// placed later are hidden there. What is lost are slivers that lie between spots.
#include <algorithm>
#include <utility>

#include "paint_world.h"
#include "threads.h"

namespace grisaille::sspm {
namespace {

// Times the shots that a pass left: when the next one pays, and when it comes before shots are
// given up.
constexpr double kGrown = 2, kGrownLeast = 1.1;
// Shots from which on it can tell whether all that wait will fit, and how many times the limit they
// are expected to take if they will not.
constexpr double kForesight = 4096, kFarTooMuch = 2;
// A spot that no muzzle sees of so many lies inside something, where a piece's plane goes on behind
// another surface. Nothing shows there.
constexpr uint32_t kInside = 4;
// How far before the spot a ray ends: a share of the range. Surfaces bend between spots.
constexpr float kEndRange = 0.05f;

}  // namespace

// A spot that older shots may still show at.
struct PaintWorld::Spot {
  const Cell* cell;
  uint32_t piece;  // of those that a call of thin() looks at
  uint64_t part;   // mask
  glm::dvec3 at;
  glm::vec3 normal;
  size_t next = 0;       // entry of the cell's list
  float sum = 0;         // of strengths
  uint32_t blocked = 0;  // shots whose muzzles do not see it
  uint32_t newest = 0;   // 1 + the newest shot that adds to it
};

// A piece, while thin() looks at its spots.
struct PaintWorld::Cover {
  uint32_t cell;  // index
  uint32_t known;
  int open = kSpots;                    // spots that older shots may show at
  uint32_t oldest = kNone, newest = 0;  // of the shots that cover the others
};

// Whether a pass is due: paint is about to go, although it got coarser, or far too much waits;
// and there are more shots than the last pass left.
bool PaintWorld::isThinningDue() const {
  const double placed = placedCount();
  if (!former_.empty() || placed <= kGrownLeast * floors_.thinned) return false;
  if (isFull()) return true;
  if (placed <= kGrown * floors_.thinned) return false;
  const auto waiting = static_cast<double>(pending_.size());
  const double all = static_cast<double>(bytes()) * (placed + waiting) / placed;
  const bool isFarTooMuch =
      placed > kForesight && waiting > placed && all > kFarTooMuch * static_cast<double>(room());
  return isFarTooMuch || isScarce();
}

// Continues a pass by some cells, or begins one if it is due. Returns whether there is more to do.
// most: number of spots after which it begins no further cell.
bool PaintWorld::thin(const CastRays& cast, size_t most) {
  if (!thinning_.isActive()) {
    if (!isThinningDue()) return false;
    thinning_.checked.resize(states_.size());
    for (const Placed& placed : placed_) {
      if (placed.cores > 0) thinning_.checked[placed.shot] = true;
    }
    for (const Work& work : partly_) thinning_.checked[work.id] = false;
  }
  thinning_.shows.resize(states_.size());
  thinning_.hiddenBy.resize(states_.size());
  std::vector<Spot> spots;
  std::vector<Cover> covers;
  const auto& cells = cells_.cells();
  for (; thinning_.cell < cells.size() && spots.size() < most; ++thinning_.cell) {
    addSpots(thinning_.cell, spots, covers);
  }
  bool casts = true;
  while (casts && !spots.empty()) casts = sumUp(spots, covers, cast);
  if (casts) cover(covers);
  if (casts && thinning_.cell < cells.size()) return true;
  if (casts) hideUnseen();
  thinning_ = {};
  noteFloors();
  floors_.thinned = placedCount();
  return false;
}

void PaintWorld::addSpots(size_t index, std::vector<Spot>& spots, std::vector<Cover>& covers) {
  const Cell& cell = cells_.cells()[index];
  for (const Entry& entry : cell.entries) {
    // Surfaces that the cell does not know.
    if ((entry.touched & cell.crowded) != 0) thinning_.shows[entry.shot] = true;
  }
  const double edge = edgeOf(cell.key.code);
  uint64_t covered = 0;  // parts with pieces that are still covered
  for (size_t known = 0; known < cell.known.size(); ++known) {
    if (!cell.fresh && cell.known[known].covered != 0) {
      covered |= uint64_t{1} << partOf(cell.known[known]);
      continue;
    }
    const SurfacePoint piece = pointOf(cell.known[known], glm::vec3(0), 1);
    for (const glm::vec3& at : spotsOf(piece, 1, 0.25f / kSpotsAWay).centres) {
      spots.push_back({.cell = &cell,
                       .piece = static_cast<uint32_t>(covers.size()),
                       .part = uint64_t{1} << piece.part,
                       .at = (glm::dvec3(cell.key.cell) + glm::dvec3(at)) * edge,
                       .normal = piece.normal});
    }
    covers.push_back({.cell = static_cast<uint32_t>(index), .known = static_cast<uint32_t>(known)});
  }
  for (const Entry& entry : cell.entries) {
    if ((entry.touched & covered) == 0) continue;
    if (entry.shot >= cell.coveredBelow) {
      thinning_.shows[entry.shot] = true;
    } else {
      uint32_t& by = thinning_.hiddenBy[entry.shot];
      by = std::max(by, cell.coverer + 1);
    }
  }
}

// How strong a shot's paint is at a spot, if the muzzle sees it; 0: out of range.
// ray: from the muzzle to the spot.
float PaintWorld::strengthAt(const Spot& spot, const Entry& entry, grisaille_ray& ray) const {
  Reach found{.shot = entry.shot};
  if ((entry.touched & spot.part) == 0 || !reach(spot.at, spot.normal, entry, found)) return 0;
  const Shot& shot = list_[entry.shot];
  const glm::vec3 q(spot.at - glm::dvec3(shot.origin[0], shot.origin[1], shot.origin[2]));
  const float range = rangeOf(entry.shot), distance = glm::length(q);
  const glm::vec3 unit = q / std::max(distance, 1e-20f);
  ray = {.origin = {shot.origin[0], shot.origin[1], shot.origin[2]},
         .direction = {unit.x, unit.y, unit.z},
         .reach = std::max(distance - kEndRange * range, 1e-20f)};
  return rules_.strength(static_cast<float>(glm::length(found.across)), range, found.times);
}

// Adds the next shot to each spot, and removes spots that no older shot can add to. Returns false
// if the host casts no rays.
bool PaintWorld::sumUp(std::vector<Spot>& spots, std::vector<Cover>& covers, const CastRays& cast) {
  std::vector<grisaille_ray> rays(spots.size());
  std::vector<float> strengths(spots.size());
  const auto toNext = [&](size_t i) {
    Spot& spot = spots[i];
    const auto& entries = spot.cell->entries;
    strengths[i] = 0;
    for (; spot.next < entries.size(); ++spot.next) {
      strengths[i] = strengthAt(spot, entries[spot.next], rays[i]);
      if (strengths[i] > 0) break;
    }
  };
  onAllThreads((spots.size() + 255) / 256, [&](size_t block) {
    for (size_t i = block * 256; i < std::min(block * 256 + 256, spots.size()); ++i) toNext(i);
  });
  std::vector<size_t> asked;
  std::vector<grisaille_ray> batch;
  for (size_t i = 0; i < spots.size(); ++i) {
    if (strengths[i] <= 0) {
      if (spots[i].sum <= 0 && spots[i].blocked >= kInside) --covers[spots[i].piece].open;
      continue;
    }
    asked.push_back(i);
    batch.push_back(rays[i]);
  }
  std::vector<grisaille_hit> hits(batch.size());
  if (!batch.empty() && !cast(batch, hits)) return false;
  std::vector<Spot> left;
  for (size_t k = 0; k < asked.size(); ++k) {
    Spot& spot = spots[asked[k]];
    const uint32_t shot = spot.cell->entries[spot.next++].shot;
    if (hits[k].kind != GRISAILLE_HIT_SURFACE || hits[k].distance >= batch[k].reach) {
      thinning_.shows[shot] = true;
      spot.sum += strengths[asked[k]];
      spot.newest = std::max(spot.newest, shot + 1);
    } else {
      ++spot.blocked;
    }
    if (spot.sum < 1) {
      left.push_back(spot);
    } else {
      Cover& piece = covers[spot.piece];
      --piece.open;
      piece.oldest = std::min(piece.oldest, shot);
      piece.newest = std::max(piece.newest, spot.newest - 1);
      hideOlder(spot);
    }
  }
  spots = std::move(left);
  return true;
}

// Notes what hides the shots that come too late at a spot.
void PaintWorld::hideOlder(const Spot& spot) {
  const auto& entries = spot.cell->entries;
  for (size_t i = spot.next; i < entries.size(); ++i) {
    grisaille_ray ray;
    if (strengthAt(spot, entries[i], ray) <= 0) continue;
    uint32_t& by = thinning_.hiddenBy[entries[i].shot];
    by = std::max(by, spot.newest);
  }
}

// Notes which pieces are covered, and removes the shots from the cells' lists that show on no
// piece.
void PaintWorld::cover(std::span<const Cover> covers) {
  for (size_t first = 0; first < covers.size();) {
    Cell& cell = cells_.cells()[covers[first].cell];
    if (cell.fresh || cell.coveredBelow == 0) {
      cell.coveredBelow = kNone;
      cell.coverer = 0;
    }
    bool any = false;
    size_t i = first;
    for (; i < covers.size() && covers[i].cell == covers[first].cell; ++i) {
      const bool covered = covers[i].open == 0;
      cell.known[covers[i].known].covered = covered ? 1 : 0;
      if (!covered) continue;
      any = true;
      cell.coveredBelow = std::min(cell.coveredBelow, covers[i].oldest);
      cell.coverer = std::max(cell.coverer, covers[i].newest);
    }
    first = i;
    cell.fresh = false;
    if (cell.coveredBelow == kNone) cell.coveredBelow = 0;
    if (!any) continue;
    sampled_ = true;
    cell.coverer = std::max(cell.coverer, lengthBefore_);
    prune(cell);
    cells_.change(cell);
  }
}

// Ends a pass: hides the shots that show at no spot, but are hidden at some. If the list gets as
// short as it was before this pass, all come back: slivers of them may have shown until then.
void PaintWorld::hideUnseen() {
  for (uint32_t id = 0; id < thinning_.checked.size(); ++id) {
    const uint32_t record = states_[id].record;
    if (!thinning_.checked[id] || thinning_.shows[id] || thinning_.hiddenBy[id] == 0) continue;
    if (record == kNone || placed_[record].hidden) continue;
    states_[id].lostTo = std::max({states_[id].lostTo, thinning_.hiddenBy[id], lengthBefore_ + 1});
    sampled_ = true;
    hide(record);
  }
}

}  // namespace grisaille::sspm
