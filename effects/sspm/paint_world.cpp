// SPDX-License-Identifier: MIT
#include "paint_world.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

namespace grisaille::sspm {
namespace {

constexpr size_t kRecordWords = 16;  // of a shot, as shaders/sspm/surface.comp reads it
constexpr size_t kMostLevels = 16;
constexpr float kMargin = 1e-3f;   // of a cell's edge, that patches are widened by
constexpr float kNearTie = 0.98f;  // a normal between two axes belongs to both

double edgeOf(int32_t code) {
  return std::ldexp(1.0, exponentOf(code));
}

// The lower corner of a cell from the muzzle, metres.
glm::vec3 cornerFrom(const CellKey& key, const glm::dvec3& origin) {
  return glm::vec3(glm::dvec3(key.cell) * edgeOf(key.code) - origin);
}

glm::vec3 unpackPoint(uint32_t point) {
  return (glm::vec3(point & 1023u, point >> 10 & 1023u, point >> 20) + 0.5f) / 1024.0f;
}

uint32_t packPoint(const glm::vec3& inCell) {
  const glm::uvec3 p(glm::clamp(inCell * 1024.0f, 0.0f, 1023.0f));
  return p.x | p.y << 10 | p.z << 20;
}

uint64_t partOf(uint32_t point) {
  return uint64_t{1} << ((point >> 8 & 3u) | (point >> 18 & 3u) << 2 | (point >> 28 & 3u) << 4);
}

float across(const ShotFrame& frame, const glm::vec3& q) {
  return glm::length(glm::cross(q, frame.direction));
}

}  // namespace

size_t PaintWorld::update(std::span<const grisaille_shot> shots, size_t kept,
                          const PaintRules& rules, double patience, const CastRays& cast) {
  const auto start = std::chrono::steady_clock::now();
  list_ = shots;
  if (!(rules == rules_)) {
    rules_ = rules;
    kept = 0;
  }
  drop(std::min(kept, shots.size()));
  for (size_t i = states_.size(); i < shots.size(); ++i)
    pending_.push_back(static_cast<uint32_t>(i));
  states_.resize(shots.size());
  shots_.resize(std::max(shots_.size(), shots.size() * kRecordWords));

  std::vector<uint32_t> unknown;
  while (!pending_.empty()) {
    const uint32_t id = pending_.back();
    MapState state = MapState::kSeen;
    if (!place(id, cast, state)) {
      if (state == MapState::kNoRays) break;
      unknown.push_back(id);
    }
    pending_.pop_back();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (spent.count() >= patience) break;
  }
  pending_.insert(pending_.end(), unknown.rbegin(), unknown.rend());
  std::ranges::sort(pending_);
  return pending_.size();
}

// Forgets all shots but the first `count`; those that had lost cells to them are to be placed anew.
void PaintWorld::drop(size_t count) {
  if (count >= states_.size()) return;
  if (count == 0) {
    cells_.clear();
    runs_.clear();
    states_.clear();
    pending_.clear();
    levels_.clear();
    return;
  }
  const auto gone = [&](uint32_t id) { return id >= count || states_[id].lostTo > count; };
  for (Cell& cell : cells_.cells()) {
    if (std::erase_if(cell.entries, [&](const Entry& entry) { return gone(entry.shot); }) > 0) {
      cells_.publish(cell);
    }
  }
  std::erase_if(pending_, [&](uint32_t id) { return gone(id); });
  for (uint32_t id = 0; id < states_.size(); ++id) {
    if (!gone(id)) continue;
    if (states_[id].blocks > 0) runs_.give(states_[id].base, states_[id].blocks);
    states_[id] = {};
    if (id < count) pending_.push_back(id);
  }
  std::ranges::sort(pending_);
  states_.resize(count);
}

// Cells about half a range wide, so that a shot lies in some twenty; wide enough for their numbers
// to fit where the shot stands.
int32_t PaintWorld::levelFor(float range, const glm::dvec3& origin) {
  const glm::dvec3 far = glm::abs(origin) + 1e3 * double{range};
  const double least = std::max({far.x, far.y, far.z}) * 0x1p-28;
  const int exponent = std::max(static_cast<int>(std::lround(std::log2(range * 0.5f))),
                                static_cast<int>(std::ceil(std::log2(least))));
  const int32_t code = levelCode(std::clamp(exponent, -40, 40));
  if (std::ranges::find(levels_, code) != levels_.end()) return code;
  if (levels_.size() < kMostLevels) {
    levels_.push_back(code);
    return code;
  }
  // Any width is right, the wider the slower: the next wider, or the widest.
  int32_t best = *std::ranges::max_element(levels_);
  for (const int32_t level : levels_) {
    if (level >= code) best = std::min(best, level);
  }
  return best;
}

bool PaintWorld::place(uint32_t id, const CastRays& cast, MapState& state) {
  const grisaille_shot& shot = list_[id];
  const float range = shot.range > 0 ? shot.range : rules_.range;
  ShotMap map;
  state = seeFrom(shot, range, cast, map);
  if (state != MapState::kSeen) return false;

  const int32_t level = levelFor(range, map.frame.origin);
  Shares shares;
  for (const Patch& patch : map.patches) spread(map, patch, level, shares);

  const uint32_t blocks = static_cast<uint32_t>(map.blocks.size() / 4);
  State& own = states_[id];
  own = {};
  if (blocks > 0) {
    own.base = runs_.take(blocks);
    own.blocks = blocks;
    std::ranges::copy(map.blocks, blocks_.change(size_t{own.base} * 4, map.blocks.size()).begin());
  }
  writeRecord(id, map, own.base);
  for (const auto& [key, share] : shares) {
    if (join(id, map, key, share)) ++own.cells;
  }
  if (own.cells == 0) unlist(id, 0);
  return true;
}

// Enters a patch into the shares of the cells that it touches.
void PaintWorld::spread(const ShotMap& map, const Patch& patch, int32_t level,
                        Shares& shares) const {
  const double edge = edgeOf(level);
  const glm::vec3 normal(patch.plane);
  glm::vec3 low = patch.hit, high = patch.hit;
  for (const glm::vec3& corner : patch.corners) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const float margin = static_cast<float>(edge) * kMargin + map.frame.bias;
  const glm::ivec3 first(glm::floor((map.frame.origin + glm::dvec3(low - margin)) / edge));
  const glm::ivec3 last(glm::floor((map.frame.origin + glm::dvec3(high + margin)) / edge));
  const float half = static_cast<float>(edge) * 0.5f;
  const float reach = glm::dot(glm::abs(normal), glm::vec3(half)) + margin;
  const glm::vec3 size = glm::abs(normal);
  const float most = std::max({size.x, size.y, size.z});
  for (int x = first.x; x <= last.x; ++x) {
    for (int y = first.y; y <= last.y; ++y) {
      for (int z = first.z; z <= last.z; ++z) {
        CellKey key{{x, y, z}, level};
        const glm::vec3 corner = cornerFrom(key, map.frame.origin);
        const glm::vec3 centre = corner + half;
        if (std::abs(glm::dot(normal, centre) - patch.plane.w) > reach) continue;
        if (across(map.frame, centre) > map.frame.range + 1.7321f * half) continue;
        for (int axis = 0; axis < 3; ++axis) {
          if (size[axis] < kNearTie * most) continue;
          key.code = level + axis * 2 + (normal[axis] < 0 ? 1 : 0);
          Share& share = shares[key];
          if (share.plane == glm::vec4(0)) share.plane = patch.plane;
          share.plain = share.plain &&
                        std::abs(glm::dot(glm::vec3(share.plane), patch.hit) - share.plane.w) <=
                            0.25f * map.frame.bias &&
                        glm::dot(glm::vec3(share.plane), normal) > 0.98f;
          share.ragged = share.ragged || patch.ragged;
          for (int i = -1; i < 4; ++i) {
            const glm::vec3 at =
                ((i < 0 ? patch.hit : patch.corners[i] * 0.98f + patch.hit * 0.02f) - corner) /
                static_cast<float>(edge);
            if (glm::any(glm::lessThan(at, glm::vec3(0))) ||
                glm::any(glm::greaterThanEqual(at, glm::vec3(1)))) {
              continue;
            }
            const uint32_t point = packPoint(at);
            if ((share.parts & partOf(point)) != 0) continue;
            share.parts |= partOf(point);
            share.points.push_back(point);
          }
        }
      }
    }
  }
}

// Enters a shot into a cell's list, and takes out what it hides there. False where newer paint
// hides the shot itself.
bool PaintWorld::join(uint32_t id, const ShotMap& map, const CellKey& key, const Share& share) {
  Cell& cell = cells_.at(key);
  auto position = std::ranges::lower_bound(cell.entries, id, std::greater<>(), &Entry::shot);
  for (auto it = cell.entries.begin(); it != position; ++it) {
    if (it->seals && paintsAll(it->shot, cell, share)) {
      states_[id].lostTo = std::max(states_[id].lostTo, it->shot + 1);
      return false;
    }
  }
  for (const uint32_t point : share.points) {
    if ((cell.parts & partOf(point)) != 0) continue;
    cell.parts |= partOf(point);
    cell.points.push_back(point);
  }
  Entry entry{.shot = id, .word = map.root, .seals = false};
  if (share.plain && !share.ragged && (map.root & kNode) != 0) {
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
  entry.seals = seals(map, cell, share);
  if (entry.seals) {
    for (auto it = position; it != cell.entries.end(); ++it) unlist(it->shot, id + 1);
    cell.entries.erase(position, cell.entries.end());
    cell.entries.push_back(entry);
  } else {
    cell.entries.insert(position, entry);
  }
  cells_.publish(cell);
  return true;
}

// Whether the shot paints all that is known of a cell, solidly.
bool PaintWorld::seals(const ShotMap& map, const Cell& cell, const Share& share) const {
  if (share.ragged) return false;
  const float solid = rules_.solid(map.frame.range);
  const float edge = static_cast<float>(edgeOf(cell.key.code));
  const glm::vec3 corner = cornerFrom(cell.key, map.frame.origin);
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 q = corner + edge * glm::vec3(i & 1, i >> 1 & 1, i >> 2);
    if (glm::dot(q, map.frame.direction) < 0 || across(map.frame, q) > solid) return false;
  }
  return std::ranges::all_of(cell.points, [&](uint32_t point) {
    return inSight(map.frame, map.root, map.blocks.data(), corner + edge * unpackPoint(point),
                   glm::vec3(share.plane));
  });
}

bool PaintWorld::paintsAll(uint32_t id, const Cell& cell, const Share& share) const {
  const ShotFrame frame = frameOf(id);
  const uint32_t root = shots_.data()[id * kRecordWords + 15];
  const uint32_t* blocks = blocks_.data() + size_t{states_[id].base} * 4;
  const float edge = static_cast<float>(edgeOf(cell.key.code));
  const glm::vec3 corner = cornerFrom(cell.key, frame.origin);
  return std::ranges::all_of(share.points, [&](uint32_t point) {
    return inSight(frame, root, blocks, corner + edge * unpackPoint(point), glm::vec3(share.plane));
  });
}

// A cell has dropped a shot for shot `to` - 1; its map goes with the last.
void PaintWorld::unlist(uint32_t id, uint32_t to) {
  State& state = states_[id];
  state.lostTo = std::max(state.lostTo, to);
  if (state.cells > 0) --state.cells;
  if (state.cells > 0 || state.blocks == 0) return;
  runs_.give(state.base, state.blocks);
  state.blocks = 0;
}

void PaintWorld::writeRecord(uint32_t id, const ShotMap& map, uint32_t base) {
  const grisaille_shot& shot = list_[id];
  const auto record = shots_.change(id * kRecordWords, kRecordWords);
  const glm::dvec3 whole = glm::floor(map.frame.origin);
  for (int axis = 0; axis < 3; ++axis) {
    const size_t i = static_cast<size_t>(axis);
    record[i] = static_cast<uint32_t>(static_cast<int32_t>(whole[axis]));
    record[4 + i] =
        std::bit_cast<uint32_t>(static_cast<float>(map.frame.origin[axis] - whole[axis]));
    record[8 + i] = std::bit_cast<uint32_t>(map.frame.direction[axis]);
  }
  record[3] = std::bit_cast<uint32_t>(map.frame.range);
  record[7] = std::bit_cast<uint32_t>(map.frame.slope);
  record[11] = std::bit_cast<uint32_t>(map.frame.bias);
  record[12] = glm::packHalf2x16(glm::vec2(shot.color[0], shot.color[1]));
  record[13] = glm::packHalf2x16(glm::vec2(shot.color[2], 0));
  record[14] = base;
  record[15] = map.root;
}

ShotFrame PaintWorld::frameOf(uint32_t id) const {
  const grisaille_shot& shot = list_[id];
  const uint32_t* record = shots_.data() + id * kRecordWords;
  ShotFrame frame;
  frame.origin = glm::dvec3(shot.origin[0], shot.origin[1], shot.origin[2]);
  frame.direction = glm::vec3(shot.direction[0], shot.direction[1], shot.direction[2]);
  setAxes(frame);
  frame.range = std::bit_cast<float>(record[3]);
  frame.slope = std::bit_cast<float>(record[7]);
  frame.bias = std::bit_cast<float>(record[11]);
  return frame;
}

size_t PaintWorld::bytes() const {
  return cells_.bytes() + shots_.bytes() + blocks_.bytes() + states_.capacity() * sizeof(State) +
         pending_.capacity() * sizeof(uint32_t);
}

}  // namespace grisaille::sspm
