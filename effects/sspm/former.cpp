// SPDX-License-Identifier: MIT
// Shots that are placed anew, because a rule has changed or newer shots were undone. Surveys take
// long. Until a shot's turn comes, it stays as it was placed before, by a former record and former
// entries. It is drawn with the rules of now. Where `paint_range` has grown, the rim of its map
// stands for what lies beyond, and its entries spread along the surfaces of their cells.
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "paint_world.h"

namespace grisaille::sspm {
namespace {

constexpr float kMostMore = 1.5f;  // cells that a larger range reaches beyond a surface
constexpr float kPiece = 0.35f;    // cells from a piece's point to the farthest of its neighbours

// A known piece, with its position in cells from its cell's lower corner.
struct Plane {
  glm::vec3 at, normal;
};

// Mask of a cell's parts that one of the planes comes close to, near its point.
// offset: of the cell from that of the planes. reach: how far a plane goes on from its point. Both
// in cells.
uint64_t partsNear(const std::vector<Plane>& planes, const glm::ivec3& offset, float reach) {
  constexpr float kMargin = (kPartMargin + kCoreSlack) / 4;
  uint64_t parts = 0;
  for (const Plane& plane : planes) {
    const glm::vec3 size = glm::abs(plane.normal);
    const float half = 0.5f * (size.x + size.y + size.z);  // of a cell, along the normal
    const glm::vec3 from = glm::vec3(offset) - plane.at;
    if (std::abs(glm::dot(plane.normal, from + 0.5f)) > half + kMargin) continue;
    for (int part = 0; part < 64; ++part) {
      const glm::vec3 apart = from + middleOf(part);
      if (glm::dot(apart, apart) > reach * reach) continue;
      const float off = glm::dot(plane.normal, apart);
      if (std::abs(off) <= half / 4 + kMargin) parts |= uint64_t{1} << part;
    }
  }
  return parts;
}

// Those of a cell's parts that a shot's cylinder reaches.
// muzzle: from the cell's lower corner. range: of the shot. Both in cells.
uint64_t partsInReach(uint64_t parts, const glm::vec3& muzzle, const glm::vec3& direction,
                      float range) {
  constexpr float kHalf = 0.8661f;  // of a cell's or a part's diagonal, in its widths
  const auto isIn = [&](const glm::vec3& middle, float half) {
    const glm::vec3 q = middle - muzzle, across = glm::cross(q, direction);
    const float reach = range + half;
    return glm::dot(across, across) < reach * reach && glm::dot(q, direction) > -half;
  };
  if (!isIn(glm::vec3(0.5f), kHalf)) return 0;
  uint64_t reached = 0;
  for (uint64_t left = parts; left != 0; left &= left - 1) {
    const int part = std::countr_zero(left);
    if (isIn(middleOf(part), kHalf / 4)) reached |= uint64_t{1} << part;
  }
  return reached;
}

}  // namespace

// Index of an entry's record; kNone: none.
uint32_t PaintWorld::recordOf(const Entry& entry) const {
  return entry.former ? former_[entry.shot] : states_[entry.shot].record;
}

// Where the index of a record is kept.
uint32_t& PaintWorld::slotOf(uint32_t record) {
  const uint32_t id = placed_[record].shot;
  return states_[id].record == record ? states_[id].record : former_[id];
}

// Makes placed shots former, and all shots pending.
// anew: which shots. count: of leading shots that stay in the list.
void PaintWorld::placeAnew(const std::vector<bool>& anew, size_t count) {
  const auto isAnew = [&](uint32_t id) { return id < count && anew[id]; };
  for (Cell& cell : cells_.cells()) {
    sweepCell(cell);  // A shot may be former already.
    bool any = false;
    for (Entry& entry : cell.entries) {
      if (!isAnew(entry.shot)) continue;
      entry.former = any = true;
      entry.solid = 0;
    }
    if (!any) continue;
    cell.unseal();
    cells_.change(cell);
  }
  if (!former_.empty()) former_.resize(count, kNone);
  const auto isAtWork = [&](const Work& work) { return isAnew(work.id); };
  std::erase_if(work_, isAtWork);
  std::erase_if(partly_, isAtWork);
  for (uint32_t id = 0; id < count; ++id) {
    if (!anew[id]) continue;
    if (states_[id].record != kNone) {
      former_.resize(count, kNone);
      former_[id] = std::exchange(states_[id].record, kNone);
    }
    if (!former_.empty() && former_[id] != kNone) writeRecord(former_[id]);
    states_[id].lostTo = 0;
    if (id >= floors_.given) pending_.push_back(id);
  }
  sortPending();
}

// Ends a shot's former place: it paints nothing there any more.
void PaintWorld::retire(uint32_t id) {
  if (id < former_.size() && former_[id] != kNone) hide(former_[id]);
}

// All shots are placed anew, and no entry is former.
void PaintWorld::dropFormer() {
  former_ = {};
  cells_.removeEmpty();
  levels_.clear();
  for (const Cell& cell : cells_.cells()) {
    const int32_t level = levelCode(exponentOf(cell.key.code));
    if (std::ranges::find(levels_, level) == levels_.end()) levels_.push_back(level);
  }
}

// The shot of a cell's entry.
PaintWorld::CellRay PaintWorld::rayIn(const Cell& cell, const Entry& entry) const {
  const double edge = edgeOf(cell.key.code);
  const Shot& shot = list_[entry.shot];
  const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
  return {.shot = entry.shot,
          .muzzle = glm::vec3(origin / edge - glm::dvec3(cell.key.cell)),
          .direction = {shot.direction[0], shot.direction[1], shot.direction[2]},
          .range = static_cast<float>(rangeOf(entry.shot) / edge)};
}

// Groups of a cell get their masks back, once no former shot is left.
void PaintWorld::tighten(Cell& cell) {
  if (!cell.wide || !former_.empty()) return;
  cell.wide = false;
  cell.groups.clear();
  const int axis = axisOf(cell.key.code);
  for (size_t i = 0; i < cell.entries.size(); ++i) {
    const Entry& entry = cell.entries[i];
    cell.groups.insert(i, axis, [&] {
      const CellRay ray = rayIn(cell, entry);
      return reachOf(entry.touched, axis, ray.muzzle, ray.direction, ray.range);
    });
  }
}

// Lists former shots in the cells that a larger range reaches. Their groups have no masks
// meanwhile.
void PaintWorld::spread() {
  const size_t count = cells_.cells().size();
  for (size_t i = 0; i < count; ++i) spread(cells_.cells()[i]);
}

void PaintWorld::spread(Cell& cell) {
  const double edge = edgeOf(cell.key.code);
  // The former shots on surfaces of this cell whose range has grown. Newest first.
  std::vector<CellRay> grown;
  double most = 0;  // by how much, cells
  for (size_t i = 0; i < cell.entries.size(); ++i) {
    const Entry& entry = cell.entries[i];
    if (!entry.former) continue;
    const float more = rangeOf(entry.shot) - placed_[recordOf(entry)].mapRange;
    if (more <= 0) continue;
    cell.groups.widen(i);
    cell.wide = true;
    if (!entry.core) continue;
    grown.push_back(rayIn(cell, entry));
    most = std::max(most, more / edge);
  }
  if (grown.empty()) return;
  std::vector<Plane> planes;
  for (const KnownPoint& known : cell.known) {
    const SurfacePoint point = pointOf(known, glm::vec3(0), 1);
    planes.push_back({point.at, point.normal});
  }
  const CellKey middle = cell.key;
  const float reach = kPiece + std::min(static_cast<float>(most), kMostMore);
  const int rings = static_cast<int>(std::ceil(reach)), width = 2 * rings + 1;
  for (int i = 0; i < width * width * width; ++i) {
    const glm::ivec3 offset = glm::ivec3(i % width, i / width % width, i / width / width) - rings;
    const uint64_t near = partsNear(planes, offset, reach);
    if (near != 0) spreadTo({middle.cell + offset, middle.code}, near, grown, offset);
  }
}

// Lists former shots in a cell, or in more parts of it.
// near: parts to list. offset: of the cell from that of the muzzles.
void PaintWorld::spreadTo(const CellKey& key, uint64_t near, std::span<const CellRay> grown,
                          const glm::ivec3& offset) {
  Cell* cell = nullptr;
  size_t at = 0;  // in its list
  for (const CellRay& each : grown) {
    const uint64_t parts =
        partsInReach(near, each.muzzle - glm::vec3(offset), each.direction, each.range);
    if (parts == 0) continue;
    if (cell == nullptr) cell = &cells_.at(key);
    cell->wide = true;
    auto& entries = cell->entries;
    while (at < entries.size() && entries[at].shot > each.shot) ++at;
    if (at < entries.size() && entries[at].shot == each.shot) {
      entries[at].touched |= parts;
      cell->groups.widen(at);
      continue;
    }
    Placed& placed = placed_[former_[each.shot]];
    const auto reference = static_cast<uint16_t>(placed.exact.root);
    cell->insert(at, {.touched = parts, .shot = each.shot, .reference = reference, .former = true},
                 [] { return CellReach{}; });
    cell->groups.widen(at);
    ++entries_;
    ++placed.others;
  }
  if (cell != nullptr) cells_.change(*cell);
}

}  // namespace grisaille::sspm
