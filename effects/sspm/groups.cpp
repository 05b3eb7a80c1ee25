// SPDX-License-Identifier: MIT
#include "groups.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace grisaille::sspm {
namespace {

constexpr int kParts = 4;  // of a cell, along an axis
// Lines of points that stand for a part: layers along axis a, and lines in each.
constexpr int kLayers = 2, kLines = 8;
// For rounding on the device: cells, and share of the distance to the muzzle.
constexpr float kSlack = 1.0f / 256, kFarSlack = 1e-6f;

// The squares with points of the line `from + b * step` that are within reach of 0, for b from 0 to
// 1.
uint32_t squaresWithin(const glm::vec3& from, const glm::vec3& step, float reach) {
  constexpr float kAWay = Squares::kAWay;
  const float length = std::max(glm::length(step), 1e-6f);
  const float nearest = -glm::dot(from, step) / (length * length);
  const glm::vec3 off = from + step * nearest;
  const float left = reach * reach - glm::dot(off, off);
  if (left < 0) return 0;
  const float half = std::sqrt(left) / length;
  const float low = std::floor(kAWay * (nearest - half)),
              high = std::floor(kAWay * (nearest + half));
  if (high < 0 || low >= kAWay) return 0;
  const auto first = static_cast<uint32_t>(std::max(low, 0.0f));
  const auto last = static_cast<uint32_t>(std::min(high, kAWay - 1));
  return (0xFFFFu >> (Squares::kAWay - 1 - last)) & (0xFFFFu << first);
}

// The squares of a row in four parts.
uint32_t squaresIn(uint32_t parts) {
  const uint32_t spread = (parts & 1) | (parts & 2) << 3 | (parts & 4) << 6 | (parts & 8) << 9;
  return spread * 0xFu;
}

// The parts in a row along axis b: in a layer along axis a, and in one along axis c.
uint32_t partsAt(uint64_t parts, int axis, int layerA, int layerC) {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  const uint64_t from = parts >> (layerA << 2 * axis | layerC << 2 * c);
  uint32_t row = 0;
  for (int i = 0; i < kParts; ++i) row |= static_cast<uint32_t>(from >> (i << 2 * b) & 1) << i;
  return row;
}

// Share of the squares of its parts that a mask does not have.
uint16_t missedBy(const CellReach& mask, int axis) {
  uint32_t crossed = 0, reached = 0;
  for (int i = 0; i < 2 * kParts; ++i) {
    const int layer = i / kParts * 2, row = i % kParts;
    const uint32_t columns =
        partsAt(mask.parts, axis, layer, row) | partsAt(mask.parts, axis, layer + 1, row);
    crossed += static_cast<uint32_t>(std::popcount(columns)) * (Squares::kAWay / kParts) *
               (Squares::kAWay / kParts);
  }
  for (const uint16_t row : mask.squares.rows) reached += static_cast<uint32_t>(std::popcount(row));
  if (reached >= crossed) return crossed == 0 ? Groups::kWhole : 0;
  return static_cast<uint16_t>((crossed - reached) * Groups::kWhole / crossed);
}

}  // namespace

CellReach& CellReach::operator|=(const CellReach& other) {
  parts |= other.parts;
  for (size_t i = 0; i < squares.rows.size(); ++i) squares.rows[i] |= other.squares.rows[i];
  return *this;
}

// In each line of points along axis b, those in range are within the roots of a quadratic. Lines
// stand for what is near them: the range is larger by the farthest that the ray can be from there.
CellReach reachOf(uint64_t parts, int axis, const glm::vec3& muzzle, const glm::vec3& direction,
                  float range) {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  const auto across = [&](int of) {
    glm::vec3 unit(0);
    unit[of] = 1;
    return glm::cross(unit, direction);
  };
  // A point's offset from the ray is linear in the point's place.
  const glm::vec3 from = glm::cross(-muzzle, direction);
  const glm::vec3 alongA = across(axis), alongB = across(b), alongC = across(c);
  const float reach = range + glm::length(alongA) / (2 * kParts * kLayers) +
                      glm::length(alongC) / (2 * kParts * kLines) + kSlack +
                      kFarSlack * glm::length(muzzle);
  CellReach result{.parts = parts, .squares = {}};
  const auto add = [&](int partA, int partC, uint32_t columns) {
    for (int layer = partA * kLayers; layer < (partA + 1) * kLayers; ++layer) {
      for (int line = partC * kLines; line < (partC + 1) * kLines; ++line) {
        const glm::vec3 start = from +
                                alongA * ((static_cast<float>(layer) + 0.5f) / (kParts * kLayers)) +
                                alongC * ((static_cast<float>(line) + 0.5f) / (kParts * kLines));
        const int row = partA / 2 * Squares::kAWay + line * Squares::kAWay / (kParts * kLines);
        result.squares.rows[static_cast<size_t>(row)] |=
            static_cast<uint16_t>(squaresWithin(start, alongB, reach) & squaresIn(columns));
      }
    }
  };
  for (int i = 0; i < kParts * kParts; ++i) {
    const uint32_t columns = partsAt(parts, axis, i / kParts, i % kParts);
    if (columns != 0) add(i / kParts, i % kParts, columns);
  }
  return result;
}

// Index of the group with the shot at an index, which becomes an index within it. An index after
// the last shot belongs to the last group.
size_t Groups::find(size_t& at) const {
  size_t i = 0;
  while (i + 1 < groups_.size() && at >= groups_[i].count) at -= groups_[i++].count;
  return i;
}

// Index of the mask of a group that may pay, or of the first such group after it.
size_t Groups::maskOf(size_t group) const {
  return static_cast<size_t>(std::count_if(groups_.begin(), groups_.begin() + group,
                                           [](const Group& each) { return each.mayPay(); }));
}

void Groups::insertGroup(size_t group, const Group& inserted, const CellReach& mask) {
  if (inserted.mayPay()) masks_.insert(maskOf(group), mask);
  groups_.insert(group, inserted);
}

// Index of the group for a shot at an index, which has room. A place between two groups is in both.
// Shots come at both ends of a list: groups there stay full.
size_t Groups::makeRoom(size_t at) {
  const auto takes = [&](size_t i) { return i < groups_.size() && groups_[i].count < kMost; };
  size_t i = find(at);
  if (at == 0 && i > 0 && takes(i - 1)) return i - 1;
  if (takes(i)) return i;
  if (at > 0 && at < groups_[i].count) {
    Group rest = groups_[i];
    rest.count = static_cast<uint16_t>(rest.count - at);
    groups_[i].count = static_cast<uint16_t>(at);
    insertGroup(i + 1, rest, rest.mayPay() ? masks_[maskOf(i)] : CellReach{});
  }
  i += at > 0 ? 1 : 0;
  if (at == 0 || !takes(i)) insertGroup(i, {}, {});
  return i;
}

void Groups::extendGroup(size_t group, int axis, const CellReach& reach) {
  CellReach& mask = masks_[maskOf(group)];
  mask |= reach;
  const uint16_t missed = missedBy(mask, axis);
  if (Group{.missed = missed}.mayPay()) {
    groups_[group].missed = missed;
  } else {
    dropMask(group);
  }
}

void Groups::widen(size_t at) {
  dropMask(find(at));
}

void Groups::dropMask(size_t group) {
  if (!groups_[group].mayPay()) return;
  const CellReach* dropped = &masks_[maskOf(group)];
  masks_.eraseIf([&](const CellReach& mask) { return &mask == dropped; });
  groups_[group].missed = 0;
}

void Groups::Eraser::next(bool erased) {
  if (left_ == 0) left_ = groups_.groups_[next_++].count;
  --left_;
  if (erased) --groups_.groups_[next_ - 1].count;
}

// Joins neighbours that have become small, if both may have a mask or neither.
void Groups::merge(int axis) {
  constexpr uint32_t kSmall = kMost * 3 / 4;
  size_t kept = 0, keptMasks = 0;
  const CellReach* mask = masks_.begin();
  for (const Group& group : groups_) {
    const bool masked = group.mayPay();
    const CellReach* reach = masked ? mask++ : nullptr;
    if (group.count == 0) continue;
    Group* last = kept > 0 ? &groups_[kept - 1] : nullptr;
    if (last == nullptr || last->mayPay() != masked || last->count + group.count > kSmall) {
      groups_[kept++] = group;
      if (masked) masks_[keptMasks++] = *reach;
      continue;
    }
    last->count = static_cast<uint16_t>(last->count + group.count);
    if (!masked) continue;
    masks_[keptMasks - 1] |= *reach;
    last->missed = missedBy(masks_[keptMasks - 1], axis);
    if (!last->mayPay()) --keptMasks;
  }
  groups_.truncate(kept);
  masks_.truncate(keptMasks);
}

}  // namespace grisaille::sspm
