// SPDX-License-Identifier: MIT
// Which paint in a cell newer paint hides. A part of a cell is sealed once the paint on every known
// surface in it lets through less than shows and its coverage is full, by the worst case over the
// part.
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "paint_world.h"

namespace grisaille::sspm {
namespace {

constexpr float kThrough = 1.0f / 512;  // as in shaders/sspm/surface.comp
constexpr size_t kMostSurfaces = 8;     // of a part that are known one by one
constexpr float kLeastSlant = 0.02f;    // cosine

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

bool isKnown(const Cell& cell, const glm::dvec3& origin, const SurfacePoint& point) {
  const auto edge = static_cast<float>(edgeOf(cell.key.code));
  const glm::vec3 corner = cornerFrom(cell.key, origin);
  return std::ranges::any_of(cell.known, [&](const KnownPoint& known) {
    return partOf(known.place) == point.part &&
           sameSurface(corner + edge * unpackPlace(known.place),
                       glm::vec3(glm::unpackSnorm3x10_1x2(known.normal)), point.at, point.normal,
                       edge);
  });
}

uint64_t bitOf(int part) {
  return uint64_t{1} << part;
}

}  // namespace

// By the rough picture alone: nothing that the shot reaches would show.
bool PaintWorld::isHidden(uint32_t id, const Survey& survey, int32_t level) {
  if (survey.unknown() > 0) return false;
  uint32_t sealer = 0;
  for (const Patch& patch : survey.patches()) {
    const bool hidden =
        visitParts(survey.frame(), patch, level, [&](const CellKey& key, uint64_t parts) {
          const Cell* cell = cells_.find(key);
          if (cell == nullptr || id >= cell->sealedBelow || (parts & ~cell->sealed) != 0) {
            return false;
          }
          sealer = std::max(sealer, cell->sealer);
          for (uint64_t left = parts; left != 0; left &= left - 1) {
            const SurfacePoint point = pointIn(survey.frame(), patch, key, std::countr_zero(left));
            if (!isKnown(*cell, survey.frame().origin, point)) return false;
          }
          return true;
        });
    if (!hidden) return false;
  }
  states_[id].lostTo = std::max(states_[id].lostTo, sealer + 1);
  return true;
}

bool PaintWorld::isHiddenIn(const Cell& cell, uint32_t id, const Share& share) const {
  return id < cell.sealedBelow && (share.touched & ~cell.sealed) == 0;
}

// Enters a shot into a cell's list. False where newer paint hides it.
bool PaintWorld::join(uint32_t id, const ShotFrame& frame, const ShotMap& map, const Share& share) {
  Cell& cell = cells_.at(share.key);
  for (const SurfacePoint& point : share.points) learn(cell, frame.origin, point);
  if (isHiddenIn(cell, id, share)) {
    states_[id].lostTo = std::max(states_[id].lostTo, cell.sealer + 1);
    return false;
  }
  Entry entry{.shot = id,
              .record = states_[id].record,
              .word = map.root,
              .touched = share.touched,
              .solid = share.touched & ~share.ragged};
  if (share.plain && share.ragged == 0 && (map.root & kNode) != 0) {
    // The words of planes are found by their own bits.
    for (size_t block = 0; block * 4 < map.blocks.size(); ++block) {
      const uint32_t* bits = &map.blocks[block * 4];
      if (bits[0] == std::bit_cast<uint32_t>(share.plane.x) &&
          bits[1] == std::bit_cast<uint32_t>(share.plane.y) &&
          bits[2] == std::bit_cast<uint32_t>(share.plane.z) &&
          bits[3] == std::bit_cast<uint32_t>(share.plane.w)) {
        entry.word = kPlane | static_cast<uint32_t>(block);
        break;
      }
    }
  }
  const auto edge = static_cast<float>(edgeOf(cell.key.code));
  const glm::vec3 corner = cornerFrom(cell.key, frame.origin);
  for (const KnownPoint& known : cell.known) {
    const uint64_t bit = bitOf(partOf(known.place));
    if ((entry.solid & bit) == 0) continue;
    if (!paints(frame, entry.word, map.blocks.data(), corner + edge * unpackPlace(known.place),
                glm::vec3(glm::unpackSnorm3x10_1x2(known.normal)))) {
      entry.solid &= ~bit;
    }
  }
  const auto position = std::ranges::lower_bound(cell.entries, id, std::greater<>(), &Entry::shot);
  cell.entries.insert(position, entry);
  if (cell.entries.size() >= cell.pruneAt) prune(cell);
  cells_.publish(cell);
  return true;
}

// Notes a surface that a cell did not know of: what is solid there has to paint it too.
void PaintWorld::learn(Cell& cell, const glm::dvec3& origin, const SurfacePoint& point) {
  if (isKnown(cell, origin, point)) return;
  const uint64_t bit = bitOf(point.part);
  const auto alike = std::ranges::count_if(
      cell.known, [&](const KnownPoint& known) { return partOf(known.place) == point.part; });
  if (static_cast<size_t>(alike) >= kMostSurfaces) {
    cell.crowded |= bit;
    cell.sealed &= ~bit;
    return;
  }
  const auto edge = static_cast<float>(edgeOf(cell.key.code));
  const glm::vec3 inCell = (point.at - cornerFrom(cell.key, origin)) / edge;
  const glm::vec3 low = middleOf(point.part) - 0.124f, high = middleOf(point.part) + 0.124f;
  cell.known.push_back({.place = packPlace(glm::clamp(inCell, low, high)),
                        .normal = glm::packSnorm3x10_1x2(glm::vec4(point.normal, 0))});
  for (Entry& entry : cell.entries) {
    if ((entry.solid & bit) != 0 && !paintsPoint(entry, origin, point)) {
      entry.solid &= ~bit;
      cell.sealed &= ~bit;
    }
  }
}

bool PaintWorld::paints(const ShotFrame& frame, uint32_t root, const uint32_t* blocks,
                        const glm::vec3& at, const glm::vec3& normal) const {
  return glm::dot(at, normal) < -kLeastSlant * glm::length(at) &&
         inSight(frame, root, blocks, at, normal);
}

bool PaintWorld::paintsPoint(const Entry& entry, const glm::dvec3& origin,
                             const SurfacePoint& point) const {
  const ShotFrame frame = frameOf(entry.shot);
  const glm::vec3 at = glm::vec3(origin - frame.origin) + point.at;
  return paints(frame, entry.word, blocks_.data() + size_t{placed_[entry.record].base} * 4, at,
                point.normal);
}

// Finds the sealed parts and takes out what shows nowhere.
void PaintWorld::prune(Cell& cell) {
  const auto edge = static_cast<float>(edgeOf(cell.key.code));
  const float half = edge / 8 * 1.7321f;
  std::array<float, 64> through, alphas;
  std::array<uint32_t, 64> newest;
  uint64_t started = 0;
  uint32_t below = kNone, sealer = 0;
  cell.sealed = 0;
  std::erase_if(cell.entries, [&](const Entry& entry) {
    if ((entry.touched & ~cell.sealed) == 0) {
      unlist(entry.shot, sealer + 1);
      return true;
    }
    uint64_t left = entry.solid & ~cell.sealed & ~cell.crowded;
    if (left == 0) return false;
    const grisaille_shot& shot = list_[entry.shot];
    const float range = rangeOf(entry.shot);
    const glm::vec3 direction(shot.direction[0], shot.direction[1], shot.direction[2]);
    const glm::vec3 corner =
        cornerFrom(cell.key, glm::dvec3(shot.origin[0], shot.origin[1], shot.origin[2]));
    for (; left != 0; left &= left - 1) {
      const auto part = static_cast<size_t>(std::countr_zero(left));
      const glm::vec3 middle = corner + edge * middleOf(static_cast<int>(part));
      const float across = glm::length(glm::cross(middle, direction)) + half;
      if (across >= range || glm::dot(middle, direction) < half) continue;
      if ((started >> part & 1) == 0) {
        started |= bitOf(static_cast<int>(part));
        through[part] = 1;
        alphas[part] = 0;
        newest[part] = entry.shot;
      }
      const float alpha = std::min(1.0f, rules_.full / across);
      const float fade = rules_.fade > 0 ? std::min(1.0f, (1 - across / range) / rules_.fade) : 1;
      through[part] *= 1 - alpha;
      alphas[part] += alpha * fade;
      // A little over, for the device's rounding.
      if (through[part] < 0.99f * kThrough && alphas[part] >= 1.001f) {
        cell.sealed |= bitOf(static_cast<int>(part));
        sealer = std::max(sealer, newest[part]);
        below = std::min(below, entry.shot);
      }
    }
    return false;
  });
  cell.sealedBelow = cell.sealed != 0 ? below : 0;
  cell.sealer = sealer;
  cell.pruneAt = static_cast<uint32_t>(cell.entries.size() * 5 / 4 + 4);
}

// A cell has dropped a shot for shot `to` - 1; its map goes with the last.
void PaintWorld::unlist(uint32_t id, uint32_t to) {
  State& state = states_[id];
  state.lostTo = std::max(state.lostTo, to);
  if (state.record == kNone) return;
  Placed& placed = placed_[state.record];
  if (placed.cells > 0) --placed.cells;
  if (placed.cells > 0) return;
  if (placed.blocks > 0) runs_.give(placed.base, placed.blocks);
  placed.blocks = 0;
  freeRecords_.push_back(state.record);
  state.record = kNone;
}

}  // namespace grisaille::sspm
