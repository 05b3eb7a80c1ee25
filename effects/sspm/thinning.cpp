// SPDX-License-Identifier: MIT
// Where memory gets scarce, finds hidden shots by samples. prune() hides only what newer paint
// covers in the worst case: near edges and over bent surfaces, that is little. A pass looks at 4x4
// spots of each known piece of a surface instead. It sums up the strengths of the shots that see
// a spot, newest first, until the sum is 1. Shots that add nothing at any spot are hidden from then
// on. What is lost are slivers that lie between spots.
#include <algorithm>
#include <utility>

#include "paint_world.h"
#include "threads.h"

namespace grisaille::sspm {
namespace {

constexpr int kSamplesAWay = 4;
constexpr double kGrown = 1.5;  // times the shots that a pass left: when the next one pays
// How far before the spot a ray ends: a share of the range. Surfaces bend between spots.
constexpr float kEndRange = 0.05f;

// Positions of a piece's spots in its part of the cell, in cells.
glm::vec3 spotOf(const SurfacePoint& piece, int spot) {
  const glm::vec3 size = glm::abs(piece.normal);
  const int a = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  const auto off = [](int i) { return (static_cast<float>(i) + 0.5f) / kSamplesAWay - 0.5f; };
  glm::vec3 at = middleOf(piece.part);
  at[b] += off(spot % kSamplesAWay) / 4;
  at[c] += off(spot / kSamplesAWay) / 4;
  at[a] = piece.at[a] -
          (piece.normal[b] * (at[b] - piece.at[b]) + piece.normal[c] * (at[c] - piece.at[c])) /
              piece.normal[a];
  return at;
}

}  // namespace

// A spot that older shots may still show at.
struct PaintWorld::Spot {
  const Cell* cell;
  uint64_t part;  // mask
  glm::dvec3 at;
  glm::vec3 normal;
  size_t next = 0;      // entry of the cell's list
  float sum = 0;        // of strengths
  uint32_t newest = 0;  // 1 + the newest shot that adds to it
};

// Whether a pass is due: paint would get coarser now, and there are more shots than the last pass
// left.
bool PaintWorld::isThinningDue() const {
  if (!former_.empty()) return false;
  return placedCount() > kGrown * thinned_ && isScarce();
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
  const auto& cells = cells_.cells();
  for (; thinning_.cell < cells.size() && spots.size() < most; ++thinning_.cell) {
    addSpots(cells[thinning_.cell], spots);
  }
  bool casts = true;
  while (casts && !spots.empty()) casts = sumUp(spots, cast);
  if (casts && thinning_.cell < cells.size()) return true;
  if (casts) hideUnseen();
  thinning_ = {};
  thinned_ = placedCount();
  return false;
}

void PaintWorld::addSpots(const Cell& cell, std::vector<Spot>& spots) {
  for (const Entry& entry : cell.entries) {
    // Surfaces that the cell does not know.
    if ((entry.touched & cell.crowded) != 0) thinning_.shows[entry.shot] = true;
  }
  const double edge = edgeOf(cell.key.code);
  for (const KnownPoint& known : cell.known) {
    const SurfacePoint piece = pointOf(known, glm::vec3(0), 1);
    for (int i = 0; i < kSamplesAWay * kSamplesAWay; ++i) {
      const glm::dvec3 place = glm::dvec3(cell.key.cell) + glm::dvec3(spotOf(piece, i));
      spots.push_back({.cell = &cell,
                       .part = uint64_t{1} << piece.part,
                       .at = place * edge,
                       .normal = piece.normal});
    }
  }
}

// How strong a shot's paint is at a spot, if the muzzle sees it; 0: out of range.
// ray: from the muzzle to the spot.
float PaintWorld::strengthAt(const Spot& spot, const Entry& entry, grisaille_ray& ray) const {
  if ((entry.touched & spot.part) == 0 || isGone(entry)) return 0;
  const Shot& shot = list_[entry.shot];
  const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
  const glm::vec3 direction(shot.direction[0], shot.direction[1], shot.direction[2]);
  const glm::vec3 q(spot.at - origin);
  const float range = rangeOf(entry.shot), distance = glm::length(q);
  const float across = glm::length(glm::cross(q, direction));
  if (across >= range || glm::dot(q, direction) < 0 || glm::dot(q, spot.normal) >= 0) return 0;
  const float times = 1 + static_cast<float>(placed_[recordOf(entry)].counted);
  const glm::vec3 unit = q / std::max(distance, 1e-20f);
  ray = {.origin = {origin.x, origin.y, origin.z},
         .direction = {unit.x, unit.y, unit.z},
         .reach = std::max(distance - kEndRange * range, 1e-20f)};
  return rules_.strength(across, range, times);
}

// Adds the next shot to each spot, and removes spots that no older shot can add to. Returns false
// if the host casts no rays.
bool PaintWorld::sumUp(std::vector<Spot>& spots, const CastRays& cast) {
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
    if (strengths[i] <= 0) continue;
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
    }
    if (spot.sum < 1) {
      left.push_back(spot);
    } else {
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

// Ends a pass: hides the shots that show at no spot, but are hidden at some.
void PaintWorld::hideUnseen() {
  for (uint32_t id = 0; id < thinning_.checked.size(); ++id) {
    const uint32_t record = states_[id].record;
    if (!thinning_.checked[id] || thinning_.shows[id] || thinning_.hiddenBy[id] == 0) continue;
    if (record == kNone || placed_[record].hidden) continue;
    states_[id].lostTo = std::max(states_[id].lostTo, thinning_.hiddenBy[id]);
    sampled_ = true;
    hide(record);
  }
}

}  // namespace grisaille::sspm
