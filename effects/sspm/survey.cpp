// SPDX-License-Identifier: MIT
#include "survey.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace grisaille::sspm {
namespace {

constexpr float kFinestMetres = 0.004f;  // squares that are wider on the surface are split
constexpr float kFinestUnits = 1.0f / 256;
constexpr float kOpenUnits = 1.0f / 63;
constexpr int kMostProbes = 6;
constexpr glm::ivec2 kAround[] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                  {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
constexpr int kFinestAcross = static_cast<int>(2 * kMapReach / kFinestUnits);
constexpr int kFinestShift = std::countr_zero(static_cast<unsigned>(kFinestAcross));

}  // namespace

Survey::Survey(const Shot& shot, float range) : frame_(shot, range) {
  probe(64 * range);
}

// Rays in rings around the axis, which find the distance of the farthest surface in the cylinder.
void Survey::probe(float farthest) {
  farthest_ = farthest;
  frame_.setFarthest(farthest);
  squares_.assign(1, {});
  for (const float radius : {0.3f, 0.65f, 0.95f}) {
    for (int i = 0; i < 8; ++i) {
      const float angle = (static_cast<float>(i) + radius) * 0.785398f;
      squares_.push_back({.centre = radius * glm::vec2(std::cos(angle), std::sin(angle))});
    }
  }
  asked_.resize(squares_.size());
  for (size_t i = 0; i < asked_.size(); ++i) asked_[i] = static_cast<int32_t>(i);
  ask();
}

bool Survey::probed() {
  float found = 0;
  bool unknown = false;
  for (const Square& square : squares_) {
    unknown = unknown || square.sample.unknown;
    if (inRange(square.sample))
      found = std::max(found, glm::dot(square.sample.at, frame_.direction));
  }
  if (found <= 0 && unknown) return false;
  const bool first = probes_ == 0;
  if (++probes_ < kMostProbes && found > 0 && (first || found >= 1.25f * farthest_)) {
    probe(found);
    return true;
  }
  stage_ = Stage::kRough;
  squares_.assign(1, {.size = 2 * kMapReach});
  lay(0, {.inner = 1.0f / 4, .middle = 1, .outer = 4});
  asked_.clear();
  gatherLeaves(0, asked_);
  ask();
  return true;
}

size_t Survey::countUnknown(float within) const {
  return static_cast<size_t>(std::ranges::count_if(squares_, [&](const Square& square) {
    return square.children < 0 && square.sample.unknown && glm::length(square.centre) < within;
  }));
}

void Survey::askAgain() {
  asked_.clear();
  for (size_t i = 0; i < squares_.size(); ++i) {
    const Square& square = squares_[i];
    if (square.children < 0 && square.sample.unknown) asked_.push_back(static_cast<int32_t>(i));
  }
  ask();
}

void Survey::refine() {
  stage_ = Stage::kFine;
  anew_ = true;
  for (Square& square : squares_) {
    square.edge = square.ragged = false;
    square.beside = square.rim = -1;
    square.creases = {-1, -1, -1};
    square.ridges = 0;
    square.valley = false;
  }
  const auto before = static_cast<int32_t>(squares_.size());
  lay(0, {.inner = kInnerUnits, .middle = 1.0f / 4, .outer = 2});
  asked_.clear();
  gatherLeaves(0, asked_);
  std::erase_if(asked_, [&](int32_t index) { return index < before; });
  ask();
}

void Survey::ask() {
  rays_.resize(asked_.size());
  for (size_t i = 0; i < asked_.size(); ++i) {
    const glm::vec2 slope = slopeOf(frame_, at(asked_[i]).centre);
    const glm::vec3 along = alongSlope(frame_, slope);
    const float length = glm::length(along);
    const glm::vec3 unit = along / length;
    rays_[i] = {.origin = {frame_.origin.x, frame_.origin.y, frame_.origin.z},
                .direction = {unit.x, unit.y, unit.z},
                .reach = exitOf(frame_, slope) * length};
  }
}

bool Survey::take(std::span<const grisaille_hit> hits) {
  for (size_t i = 0; i < asked_.size(); ++i) {
    Sample& sample = at(asked_[i]).sample;
    sample = {};
    if (hits[i].kind == GRISAILLE_HIT_UNKNOWN) {
      const float behind = 2 * frame_.bias;
      sample = {.hit = true,
                .unknown = true,
                .plane = glm::vec4(-frame_.direction, behind),
                .at = -behind * frame_.direction};
      continue;
    }
    sample.hit = hits[i].kind == GRISAILLE_HIT_SURFACE;
    if (!sample.hit) continue;
    const glm::vec3 normal(hits[i].normal[0], hits[i].normal[1], hits[i].normal[2]);
    const auto& way = rays_[i].direction;
    sample.at = hits[i].distance * glm::vec3(way[0], way[1], way[2]);
    sample.plane = glm::vec4(normal, glm::dot(normal, sample.at));
  }
  rays_.clear();
  if (stage_ == Stage::kProbing) return probed();
  if (std::exchange(anew_, false)) {
    asked_.clear();
    gatherLeaves(0, asked_);
  }
  const std::vector<int32_t> edges = findEdges(asked_);
  if (stage_ == Stage::kFine) {
    asked_.clear();
    for (const int32_t edge : edges) {
      addChildren(edge);
      for (int32_t i = 0; i < 4; ++i) asked_.push_back(at(edge).children + i);
    }
    ask();
  }
  return true;
}

bool Survey::inRange(const Sample& sample) const {
  return sample.hit && !sample.unknown && frame_.across(sample.at) < frame_.range * kBeyond;
}

void Survey::addChildren(int32_t parent) {
  const glm::vec2 centre = at(parent).centre;
  const float size = at(parent).size / 2;
  const int fine = static_cast<int>(std::lround(size / kFinestUnits));
  at(parent).children = static_cast<int32_t>(squares_.size());
  for (int i = 0; i < 4; ++i) {
    const glm::vec2 step(static_cast<float>(i % 2) - 0.5f, static_cast<float>(i / 2) - 0.5f);
    const glm::ivec2 place = at(parent).corner + glm::ivec2(i % 2, i / 2) * fine;
    squares_.push_back({.centre = centre + size * step, .size = size, .corner = place});
  }
}

// Splits squares that are coarser than the grain.
void Survey::lay(int32_t index, const Grain& grain) {
  const glm::vec2 centre = at(index).centre;
  const float size = at(index).size;
  const float nearest = glm::length(glm::max(glm::abs(centre) - size / 2, 0.0f));
  const float wanted = nearest < 1 ? grain.inner : nearest < 3.5f ? grain.middle : grain.outer;
  if (size <= wanted * 1.01f) return;
  if (at(index).children < 0) addChildren(index);
  const int32_t first = at(index).children;
  for (int32_t i = 0; i < 4; ++i) lay(first + i, grain);
}

void Survey::gatherLeaves(int32_t index, std::vector<int32_t>& leaves) const {
  if (at(index).children < 0) {
    leaves.push_back(index);
    return;
  }
  for (int32_t i = 0; i < 4; ++i) gatherLeaves(at(index).children + i, leaves);
}

int32_t Survey::leafAt(glm::ivec2 place) const {
  int32_t index = 0;
  for (int shift = kFinestShift - 1; at(index).children >= 0; --shift) {
    index = at(index).children + (place.y >> shift & 1) * 2 + (place.x >> shift & 1);
  }
  return index;
}

// Whether a square that saw nothing agrees with `plane`: in its slope, the plane lies beyond the
// cylinder.
bool Survey::planePastExit(const Square& open, const glm::vec4& plane) const {
  const glm::vec2 slope = slopeOf(frame_, open.centre);
  const float facing = glm::dot(glm::vec3(plane), alongSlope(frame_, slope));
  return facing >= 0 || plane.w / facing >= 0.98f * frame_.range / glm::length(slope);
}

// Whether two squares may see the same surface.
bool Survey::agree(const Square& a, const Square& b) const {
  const auto onPlane = [&](const glm::vec4& plane, const glm::vec3& at) {
    return std::abs(glm::dot(glm::vec3(plane), at) - plane.w) <= 0.8f * frame_.bias;
  };
  if (a.sample.unknown || b.sample.unknown) return true;
  if (!a.sample.hit && !b.sample.hit) return true;
  if (!a.sample.hit) return planePastExit(a, b.sample.plane);
  if (!b.sample.hit) return planePastExit(b, a.sample.plane);
  return onPlane(a.sample.plane, b.sample.at) && onPlane(b.sample.plane, a.sample.at);
}

// Whether the surfaces of two neighbouring squares meet at a crease between them, convex or
// concave: each hit lies in front of the other's plane, or each behind it, and no farther from it
// than the squares are wide.
bool Survey::meet(const Square& one, const Square& other) const {
  const Sample &a = one.sample, &b = other.sample;
  const float over = glm::dot(glm::vec3(a.plane), b.at) - a.plane.w;
  const float under = glm::dot(glm::vec3(b.plane), a.at) - b.plane.w;
  const float wide = std::min(std::max(one.size, other.size), kInnerUnits) * frame_.range;
  return over * under >= 0 &&
         std::max(std::abs(over), std::abs(under)) <= 0.5f * wide + 2 * frame_.bias;
}

// Notes that the surface of the square `other` meets that of `index`, at a ridge or in a valley.
void Survey::addCrease(int32_t index, int32_t other, bool ridge) {
  Square& square = at(index);
  square.edge = true;
  square.valley = square.valley || !ridge;
  for (size_t i = 0; i < square.creases.size(); ++i) {
    if (square.creases[i] >= 0) {
      const Sample &known = at(square.creases[i]).sample, &seen = at(other).sample;
      if (sspm::serves(known.plane, seen.at, seen.plane, frame_.bias)) return;
      continue;
    }
    square.creases[i] = other;
    square.ridges |= static_cast<uint8_t>(ridge ? 1u << i : 0u);
    return;
  }
}

// Finds edges between the squares `among`, whose rays were just cast, and their neighbours. Marks
// both sides of an edge. Returns the squares to split: those at edges that are not yet fine. At an
// edge between a surface and nothing, a square need not be as fine: the muzzle sees the surface up
// to its end.
std::vector<int32_t> Survey::findEdges(const std::vector<int32_t>& among) {
  std::vector<int32_t> edges;
  const auto tell = [&](int32_t index) {
    Square& square = at(index);
    if (!square.edge && !isFine(square)) edges.push_back(index);
    square.edge = true;
  };
  // A crease hides nothing: below the grain it needs no finer squares.
  const auto crease = [&](int32_t index, int32_t other) {
    if (at(index).size > kInnerUnits) {
      tell(index);
      return;
    }
    const Sample &own = at(index).sample, &seen = at(other).sample;
    addCrease(index, other, glm::dot(glm::vec3(own.plane), seen.at) <= own.plane.w);
  };
  for (const int32_t index : among) {
    const int size = static_cast<int>(std::lround(at(index).size / kFinestUnits));
    for (const glm::ivec2 side : kAround) {
      const glm::ivec2 place = at(index).corner +
                               (size + side * (size + std::max(1, size / 5))) / 2 +
                               glm::ivec2(glm::lessThan(side, glm::ivec2(0))) * -(size & 1);
      if (glm::any(glm::lessThan(place, glm::ivec2(0))) ||
          glm::any(glm::greaterThanEqual(place, glm::ivec2(kFinestAcross)))) {
        continue;
      }
      const int32_t other = leafAt(place);
      const bool same = agree(at(index), at(other));
      const auto [open, hit] =
          at(index).sample.hit ? std::pair(other, index) : std::pair(index, other);
      if (at(open).sample.hit == at(hit).sample.hit) {
        if (same) continue;
        if (meet(at(index), at(other))) {
          crease(index, other);
          crease(other, index);
        } else {
          tell(index);
          tell(other);
          at(index).ragged = at(other).ragged = true;
        }
      } else if (same) {
        at(open).rim = hit;
      } else {
        at(open).beside = hit;
        if (at(open).size > kOpenUnits) tell(open);
        if (at(hit).size > kOpenUnits) tell(hit);
      }
    }
  }
  return edges;
}

// The square whose surface may reach into this one: a neighbour of an open square, else the square
// itself.
const Survey::Square& Survey::seenBy(const Square& square) const {
  return square.beside >= 0 ? at(square.beside) : square.rim >= 0 ? at(square.rim) : square;
}

bool Survey::isFine(const Square& square) const {
  return square.size <= kFinestUnits || square.size * frame_.range <= kFinestMetres ||
         (square.size <= kInnerUnits && glm::length(square.centre) > 4);
}

}  // namespace grisaille::sspm
