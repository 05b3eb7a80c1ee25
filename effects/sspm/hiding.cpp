// SPDX-License-Identifier: MIT
// Culls shots that newer paint hides. A cell knows the pieces of surfaces in it. A piece is sealed
// when the strengths of its paint sum up to 1, in the worst case over its part of the cell. A shot
// is hidden in a cell if all pieces that it may paint are sealed.
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "paint_world.h"

namespace grisaille::sspm {
namespace {

constexpr float kLeastSlant = 0.02f;  // least cosine between a facet's normal and the ray

glm::vec3 unpackPlace(uint32_t place) {
  return (glm::vec3(place & 1023u, place >> 10 & 1023u, place >> 20) + 0.5f) / 1024.0f;
}

uint32_t packPlace(const glm::vec3& inCell) {
  const glm::uvec3 p(glm::clamp(inCell * 1024.0f, 0.0f, 1023.0f));
  return p.x | p.y << 10 | p.z << 20;
}

int partOf(uint32_t place) {
  return static_cast<int>((place >> 8 & 3u) | (place >> 18 & 3u) << 2 | (place >> 28 & 3u) << 4);
}

SurfacePoint pointOf(const KnownPoint& known, const glm::vec3& corner, float edge) {
  return {.part = partOf(known.place),
          .at = corner + edge * unpackPlace(known.place),
          .normal = glm::vec3(glm::unpackSnorm3x10_1x2(known.normal))};
}

constexpr size_t kUnknown = ~size_t{0};

// Index of the cell's known piece that a point belongs to, or kUnknown.
size_t findKnown(const Cell& cell, const CellGrid& grid, const SurfacePoint& point) {
  const glm::vec3 corner = grid.corner(cell.key);
  const auto found = std::ranges::find_if(cell.known, [&](const KnownPoint& known) {
    if (partOf(known.place) != point.part) return false;
    const SurfacePoint other = pointOf(known, corner, grid.edge);
    return sameSurface(other.at, other.normal, point.at, point.normal, grid.edge);
  });
  return found == cell.known.end() ? kUnknown : static_cast<size_t>(found - cell.known.begin());
}

bool has(uint64_t parts, int part) {
  return (parts >> part & 1) != 0;
}

bool isHiddenIn(const Cell& cell, const Entry& entry) {
  if (entry.shot >= cell.sealedBelow || (entry.touched & cell.crowded) != 0) return false;
  bool touches = false;
  for (size_t i = 0; i < cell.known.size(); ++i) {
    if (!has(entry.touched, partOf(cell.known[i].place))) continue;
    if (!has(cell.sealed, static_cast<int>(i))) return false;
    touches = true;
  }
  return touches;
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

}  // namespace

// Whether newer paint hides all of a shot, by its rough picture.
bool PaintWorld::isHidden(uint32_t id, const Survey& survey, const CellGrid& grid) {
  if (survey.unknown() > 0) return false;
  const std::vector<Patch> patches = survey.patches();
  if (patches.empty()) return false;  // its surfaces are too thin for the rough picture
  uint32_t sealer = 0;
  for (const Patch& patch : patches) {
    const bool hidden =
        visitParts(survey.frame(), grid, patch, [&](const CellKey& key, const PartBits& bits) {
          const Cell* cell = cells_.find(key);
          if (cell == nullptr) return bits.core == 0;
          if ((bits.touched & cell->crowded) != 0) return false;
          bool touches = bits.core != 0;
          for (size_t i = 0; i < cell->known.size(); ++i) {
            if (!has(bits.touched, partOf(cell->known[i].place))) continue;
            if (!has(cell->sealed, static_cast<int>(i))) return false;
            touches = true;
          }
          if (!touches) return true;
          if (id >= cell->sealedBelow) return false;
          sealer = std::max(sealer, cell->sealer);
          for (uint64_t left = bits.core; left != 0; left &= left - 1) {
            const SurfacePoint point = pointIn(grid, patch, key, std::countr_zero(left));
            if (findKnown(*cell, grid, point) == kUnknown) return false;
          }
          return true;
        });
    if (!hidden) return false;
  }
  states_[id].lostTo = std::max(states_[id].lostTo, sealer + 1);
  return true;
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
    const int part = partOf(cell.known[i].place);
    if (!has(entry.touched, part)) continue;
    entry.core = true;
    if (!has(ragged, part) && reaches(i)) entry.solid |= uint64_t{1} << i;
  }
  if (isHiddenIn(cell, entry)) {
    states_[id].lostTo = std::max(states_[id].lostTo, cell.sealer + 1);
    return;
  }
  if (!entry.core && placed.cores == 0) return;
  const auto position = std::ranges::lower_bound(cell.entries, id, std::greater<>(), &Entry::shot);
  cell.entries.insert(static_cast<size_t>(position - cell.entries.begin()), entry);
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
  cell.known.add({.place = packPlace(glm::clamp(inCell, low, high)),
                  .normal = glm::packSnorm3x10_1x2(glm::vec4(point.normal, 0))});
  // The maps of the listed shots are on the device alone. They may paint the piece, with gaps.
  for (Entry& entry : cell.entries) {
    if (!has(entry.touched, point.part) || isGone(entry)) continue;
    if (std::exchange(entry.core, true)) continue;
    Placed& placed = placed_[states_[entry.shot].record];
    --placed.others;
    ++placed.cores;
  }
  return cell.known.size() - 1;
}

// Finds the sealed pieces, and removes hidden shots from the list.
void PaintWorld::prune(Cell& cell) {
  const auto edge = static_cast<float>(edgeOf(cell.key.code));
  const float half = edge / 8 * 1.7321f * (1 + 2 * kPartMargin);
  std::array<float, kMostKnown> strengths;
  std::array<uint32_t, kMostKnown> newest;
  strengths.fill(0);
  newest.fill(kNone);
  cell.sealed = 0;
  cell.sealedBelow = kNone;
  cell.sealer = 0;
  cell.entries.eraseIf([&](const Entry& entry) {
    if (isGone(entry) || isHiddenIn(cell, entry)) {
      unlist(entry, isGone(entry) ? 0 : cell.sealer + 1);
      return true;
    }
    if (entry.solid == 0) return false;
    const Shot& shot = list_[entry.shot];
    const float range = rangeOf(entry.shot);
    const glm::vec3 direction(shot.direction[0], shot.direction[1], shot.direction[2]);
    const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
    const glm::vec3 corner(glm::dvec3(cell.key.cell) * edgeOf(cell.key.code) - origin);
    for (size_t i = 0; i < cell.known.size(); ++i) {
      if (((entry.solid & ~cell.sealed) >> i & 1) == 0) continue;
      const int part = partOf(cell.known[i].place);
      const glm::vec3 middle = corner + edge * middleOf(part);
      const float across = glm::length(glm::cross(middle, direction)) + half;
      if (across >= range || glm::dot(middle, direction) < half) continue;
      if (newest[i] == kNone) newest[i] = entry.shot;
      const float alpha = std::min(1.0f, rules_.full / across);
      const float fade = rules_.fade > 0 ? std::min(1.0f, (1 - across / range) / rules_.fade) : 1;
      strengths[i] += alpha * fade;
      if (strengths[i] >= 1.001f) {  // allows for rounding on the device
        cell.sealed |= uint64_t{1} << i;
        cell.sealer = std::max(cell.sealer, newest[i]);
        cell.sealedBelow = std::min(cell.sealedBelow, entry.shot);
      }
    }
    return false;
  });
  if (cell.sealed == 0) cell.sealedBelow = 0;
  cell.pruneAt = static_cast<uint32_t>(cell.entries.size() * 5 / 4 + 1);
}

}  // namespace grisaille::sspm
