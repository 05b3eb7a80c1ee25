// SPDX-License-Identifier: MIT
// Culls shots that newer paint hides. A cell knows the pieces of surfaces in it. A piece is sealed
// when the strengths of its paint sum up to 1, in the worst case over its part of the cell. A shot
// is hidden in a cell if all pieces that it may paint are sealed.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "paint_world.h"

namespace grisaille::sspm {
namespace {

constexpr float kLeastSlant = 0.02f;  // least cosine between a facet's normal and the ray
constexpr float kSealed = 1.001f;     // sum of strengths; allows for rounding on the device
// Of a cell's width: how far a piece's surface may be from the plane through its known point. See
// sameSurface().
constexpr float kSurfaceSlack = 1.0f / 16;

constexpr size_t kUnknown = ~size_t{0};

// Index of the cell's known piece that a point belongs to, or kUnknown.
size_t findKnown(const Cell& cell, const CellGrid& grid, const SurfacePoint& point) {
  const glm::vec3 corner = grid.corner(cell.key);
  const auto found = std::ranges::find_if(cell.known, [&](const KnownPoint& known) {
    if (partOf(known) != point.part) return false;
    const SurfacePoint other = pointOf(known, corner, grid.edge);
    return sameSurface(other.at, other.normal, point.at, point.normal, grid.edge);
  });
  return found == cell.known.end() ? kUnknown : static_cast<size_t>(found - cell.known.begin());
}

bool has(uint64_t parts, int part) {
  return (parts >> part & 1) != 0;
}

// 1 + the newest of the shots that hide a shot on the pieces that it may paint; 0: no piece is
// known there. Nothing if the shot may show.
std::optional<uint32_t> hiderIn(const Cell& cell, uint64_t touched, uint32_t id) {
  if ((touched & cell.crowded) != 0) return std::nullopt;
  const bool sealed = id < cell.sealedBelow, covered = id < cell.coveredBelow;
  uint32_t hider = 0;
  for (size_t i = 0; i < cell.known.size(); ++i) {
    if (!has(touched, partOf(cell.known[i]))) continue;
    if (sealed && i < kMostSealed && has(cell.sealed, static_cast<int>(i))) {
      hider = std::max(hider, cell.sealer + 1);
    } else if (covered && cell.known[i].covered != 0) {
      hider = std::max(hider, cell.coverer + 1);
    } else {
      return std::nullopt;
    }
  }
  return hider;
}

// The same; 0 if the shot may show.
uint32_t hiderOf(const Cell& cell, const Entry& entry) {
  return hiderIn(cell, entry.touched, entry.shot).value_or(0);
}

// Whether the shot paints a point, whose offset is from the shot's muzzle. word: of its map.
bool paints(const ShotFrame& frame, uint32_t word, const uint32_t* blocks,
            const SurfacePoint& point) {
  return glm::dot(point.at, point.normal) < -kLeastSlant * glm::length(point.at) &&
         inSight(frame, word, blocks, point.at, point.normal);
}

// Reference to a plane in a map; to the map's root if the plane is not in it.
uint32_t referenceTo(const glm::vec4& plane, const ShotMap& map) {
  const MapBlock block = packPlane(plane);
  for (size_t at = 0; at < map.words.size(); at += 2) {
    if (map.words[at] == block[0] && map.words[at + 1] == block[1]) {
      return static_cast<uint32_t>(at / 2 + 1);
    }
  }
  return map.root;
}

// A piece's spots, and how strong the paint on each is at least.
struct Seal {
  glm::vec3 normal = glm::vec3(0);
  Spots spots;
  std::array<float, kSpots> strengths = {};
  uint32_t newest = ~0u;  // shot that paints it; ~0: none
};

Seal sealOf(const KnownPoint& known, float edge) {
  const SurfacePoint piece = pointOf(known, glm::vec3(0), edge);
  const float width = edge / 4 * (1 + 2 * kPartMargin) / kSpotsAWay;
  return {.normal = piece.normal, .spots = spotsOf(piece, edge, width)};
}

}  // namespace

// Notes if newer paint hides all of a shot, by its rough picture. Threads call it for several shots
// at the same time.
void PaintWorld::findHidden(const Work& work) {
  const uint32_t id = work.id;
  const Survey& survey = work.survey;
  const CellGrid& grid = *work.grid;
  if (survey.unknown() > 0) return;
  const std::vector<Patch> patches = survey.patches();
  if (patches.empty()) return;  // its surfaces are too thin for the rough picture
  uint32_t newest = 0;
  for (const Patch& patch : patches) {
    const bool hidden =
        visitParts(survey.frame(), grid, patch, [&](const CellKey& key, const PartBits& bits) {
          const Cell* cell = cells_.find(key);
          if (cell == nullptr) return bits.core == 0;
          const std::optional<uint32_t> hider = hiderIn(*cell, bits.touched, id);
          if (!hider) return false;
          newest = std::max(newest, *hider);
          for (uint64_t left = bits.core; left != 0; left &= left - 1) {
            const SurfacePoint point = pointIn(grid, patch, key, std::countr_zero(left));
            if (findKnown(*cell, grid, point) == kUnknown) return false;
          }
          return true;
        });
    if (!hidden) return;
  }
  states_[id].lostTo = std::max(states_[id].lostTo, newest);
}

// Adds a shot to a cell's list, unless newer paint hides it there.
// thin: no share of the shot has points.
void PaintWorld::join(uint32_t record, const ShotFrame& frame, const CellGrid& grid,
                      const ShotMap& map, const Share& share, bool thin) {
  Placed& placed = placed_[record];
  const uint32_t id = placed.shot;
  Cell& cell = cells_.at(share.key);
  Entry entry{.touched = share.touched, .shot = id, .core = thin || !share.points.empty()};
  uint64_t ragged = share.ragged;  // parts in which its paint may have gaps
  const bool plain = share.plain && ragged == 0 && map.root >= kLine;
  entry.reference = static_cast<uint16_t>(plain ? referenceTo(share.plane, map) : map.root);
  const glm::vec3 corner = grid.corner(cell.key);
  const auto reaches = [&](size_t known) {
    return paints(frame, entry.reference, map.words.data(),
                  pointOf(cell.known[known], corner, grid.edge));
  };
  for (const SurfacePoint& point : share.points) {
    const size_t known = learn(cell, grid, point);
    if (known != kUnknown && !reaches(known)) ragged |= uint64_t{1} << point.part;
  }
  for (size_t i = 0; i < cell.known.size(); ++i) {
    const int part = partOf(cell.known[i]);
    if (!has(entry.touched, part)) continue;
    entry.core = true;
    if (i < kMostSealed && !has(ragged, part) && reaches(i)) entry.solid |= uint64_t{1} << i;
  }
  if (const uint32_t hider = hiderOf(cell, entry); hider > 0) {
    states_[id].lostTo = std::max(states_[id].lostTo, hider);
    return;
  }
  if (!entry.core && placed.cores == 0) return;
  const int axis = axisOf(share.key.code);
  const auto reach = [&] {
    return reachOf(entry.touched, axis, -corner / grid.edge, frame.direction,
                   frame.range / grid.edge);
  };
  tighten(cell);
  const auto position = std::ranges::lower_bound(cell.entries, id, std::greater<>(), &Entry::shot);
  if (position != cell.entries.end() && position->shot == id && position->former) {
    unlist(*position, 0);
    *position = entry;
    cell.groups.extend(static_cast<size_t>(position - cell.entries.begin()), axis, reach);
  } else {
    cell.insert(static_cast<size_t>(position - cell.entries.begin()), entry, reach);
  }
  if (id >= cell.coveredBelow) cell.fresh = true;
  ++entries_;
  ++(entry.core ? placed.cores : placed.others);
  if (cell.entries.size() >= cell.pruneAt) prune(cell);
  cells_.change(cell);
}

// Index of the known piece that a point belongs to. Adds a piece if the cell does not know one.
// Returns kUnknown if the cell is full.
size_t PaintWorld::learn(Cell& cell, const CellGrid& grid, const SurfacePoint& point) {
  const size_t index = findKnown(cell, grid, point);
  if (index != kUnknown) return index;
  if (cell.known.size() >= kMostKnown) {
    cell.crowded |= uint64_t{1} << point.part;
    return kUnknown;
  }
  const glm::vec3 inCell = (point.at - grid.corner(cell.key)) / grid.edge;
  const glm::vec3 low = middleOf(point.part) - 0.124f, high = middleOf(point.part) + 0.124f;
  cell.known.add(knownAt(glm::clamp(inCell, low, high), point.normal));
  // The maps of the listed shots are on the device alone. They may paint the piece, with gaps.
  for (Entry& entry : cell.entries) {
    if (!has(entry.touched, point.part) || isGone(entry)) continue;
    if (thinning_.isActive() && entry.shot < thinning_.shows.size()) {
      thinning_.shows[entry.shot] = true;
    }
    if (std::exchange(entry.core, true)) continue;
    Placed& placed = placed_[recordOf(entry)];
    --placed.others;
    ++placed.cores;
  }
  return cell.known.size() - 1;
}

// Finds the sealed pieces, and removes hidden shots from the list.
void PaintWorld::prune(Cell& cell) {
  const auto edge = static_cast<float>(edgeOf(cell.key.code));
  std::vector<Seal> seals;
  for (size_t i = 0; i < std::min(cell.known.size(), kMostSealed); ++i) {
    seals.push_back(sealOf(cell.known[i], edge));
  }
  cell.sealed = 0;
  cell.sealedBelow = kNone;
  cell.sealer = 0;
  cell.eraseIf([&](const Entry& entry) {
    const uint32_t hider = hiderOf(cell, entry);
    if (isGone(entry) || hider > 0) {
      unlist(entry, isGone(entry) ? 0 : hider);
      return true;
    }
    if ((entry.solid & ~cell.sealed) == 0) return false;
    const Shot& shot = list_[entry.shot];
    const float range = rangeOf(entry.shot);
    const glm::vec3 direction(shot.direction[0], shot.direction[1], shot.direction[2]);
    const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
    const glm::vec3 corner(glm::dvec3(cell.key.cell) * edgeOf(cell.key.code) - origin);
    for (size_t i = 0; i < seals.size(); ++i) {
      if (!has(entry.solid & ~cell.sealed, static_cast<int>(i))) continue;
      Seal& seal = seals[i];
      const float slack = kSurfaceSlack * edge * glm::length(glm::cross(seal.normal, direction));
      bool all = true;
      for (size_t j = 0; j < kSpots; ++j) {
        if (seal.strengths[j] >= kSealed) continue;
        const glm::vec3 at = corner + seal.spots.centres[j];
        const float across = glm::length(glm::cross(at, direction)) + seal.spots.half + slack;
        if (across < range && glm::dot(at, direction) > seal.spots.half + slack) {
          if (seal.newest == kNone) seal.newest = entry.shot;
          seal.strengths[j] += rules_.strength(across, range, 1);
        }
        all = all && seal.strengths[j] >= kSealed;
      }
      if (!all) continue;
      cell.sealed |= uint64_t{1} << i;
      cell.sealer = std::max(cell.sealer, seal.newest);
      cell.sealedBelow = std::min(cell.sealedBelow, entry.shot);
    }
    return false;
  });
  if (cell.sealed == 0) cell.sealedBelow = 0;
  cell.pruneAt = static_cast<uint32_t>(cell.entries.size() * 5 / 4 + 1);
}

}  // namespace grisaille::sspm
