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
constexpr float kInnerUnits = 1.0f / 16;
constexpr float kOpenUnits = 1.0f / 63;
constexpr float kPatchUnits = 1.0f / 4;  // width of the largest patch
constexpr int kMostProbes = 6;
constexpr glm::ivec2 kAround[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
constexpr int kFinestAcross = static_cast<int>(2 * kMapReach / kFinestUnits);
constexpr int kFinestShift = std::countr_zero(static_cast<unsigned>(kFinestAcross));
constexpr float kBeyond = 1.02f;  // times the range: hits beyond it are outside the cylinder

glm::vec2 slopeOf(const ShotFrame& frame, glm::vec2 place) {
  const float radius = glm::length(place);
  if (radius <= 1) return place * frame.slope;
  return place * (frame.slope * std::exp(radius - 1) / radius);
}

glm::vec3 alongSlope(const ShotFrame& frame, glm::vec2 slope) {
  return slope.x * frame.right + slope.y * frame.up + frame.direction;
}

// Distance along the shot's direction at which a slope leaves the cylinder, metres.
float exitOf(const ShotFrame& frame, glm::vec2 slope) {
  const float length = glm::length(slope);
  return length > 0 ? kBeyond * frame.range / length : std::numeric_limits<float>::infinity();
}

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
  }
  const auto before = static_cast<int32_t>(squares_.size());
  lay(0, {.inner = kInnerUnits, .middle = 1.0f / 4, .outer = 1});
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
      for (int32_t i = 0; i < 16; ++i) asked_.push_back(at(edge).children + i);
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
  const float size = at(parent).size / 4;
  const int fine = static_cast<int>(std::lround(size / kFinestUnits));
  at(parent).children = static_cast<int32_t>(squares_.size());
  for (int i = 0; i < 16; ++i) {
    const glm::vec2 step(static_cast<float>(i % 4) - 1.5f, static_cast<float>(i / 4) - 1.5f);
    const glm::ivec2 place = at(parent).corner + glm::ivec2(i % 4, i / 4) * fine;
    squares_.push_back({.centre = centre + size * step, .size = size, .corner = place});
  }
}

// Splits squares that are coarser than the grain.
void Survey::lay(int32_t index, const Grain& grain) {
  const glm::vec2 centre = at(index).centre;
  const float size = at(index).size;
  const float nearest = glm::length(glm::max(glm::abs(centre) - size / 2, 0.0f));
  const float wanted = nearest < 1 ? grain.inner : nearest < 3 ? grain.middle : grain.outer;
  if (size <= wanted * 1.01f) return;
  if (at(index).children < 0) addChildren(index);
  const int32_t first = at(index).children;
  for (int32_t i = 0; i < 16; ++i) lay(first + i, grain);
}

void Survey::gatherLeaves(int32_t index, std::vector<int32_t>& leaves) const {
  if (at(index).children < 0) {
    leaves.push_back(index);
    return;
  }
  for (int32_t i = 0; i < 16; ++i) gatherLeaves(at(index).children + i, leaves);
}

int32_t Survey::leafAt(glm::ivec2 place) const {
  int32_t index = 0;
  for (int shift = kFinestShift - 2; at(index).children >= 0; shift -= 2) {
    index = at(index).children + (place.y >> shift & 3) * 4 + (place.x >> shift & 3);
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
// concave: each hit lies in front of the other's plane, or each behind it, and within two biases.
bool Survey::meet(const Sample& a, const Sample& b) const {
  const float over = glm::dot(glm::vec3(a.plane), b.at) - a.plane.w;
  const float under = glm::dot(glm::vec3(b.plane), a.at) - b.plane.w;
  return over * under >= 0 && std::max(std::abs(over), std::abs(under)) <= 2 * frame_.bias;
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
        tell(index);
        tell(other);
        if (!meet(at(index).sample, at(other).sample)) {
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

std::vector<Patch> Survey::patches() const {
  std::vector<Patch> result;
  gatherPatches(0, result);
  return result;
}

void Survey::gatherPatches(int32_t index, std::vector<Patch>& patches) const {
  const Square& square = at(index);
  if (square.children < 0 && !square.edge) {
    const Sample& sample = seenBy(square).sample;
    if (inRange(sample)) patches.push_back(patchOf(square, sample.plane));
    return;
  }
  const Square* leaf = nullptr;
  if (square.size <= kPatchUnits * 1.01f && uniform(index, leaf, true)) {
    if (leaf == nullptr || leaf->sample.unknown) return;
    const Patch patch = patchOf(square, leaf->sample.plane);
    if (patch.whole) {
      patches.push_back(patch);
      return;
    }
  }
  if (square.children >= 0 && square.size > kInnerUnits * 1.01f) {
    for (int32_t i = 0; i < 16; ++i) gatherPatches(square.children + i, patches);
    return;
  }
  // A finely split square: one patch for each of its planes, over the whole square.
  std::vector<SeenPlane> planes;
  const bool ragged = gatherPlanes(index, planes);
  for (SeenPlane& plane : planes) {
    Patch& patch = patches.emplace_back(patchOf(square, plane.sample->plane));
    patch.centre = plane.sample->at;
    patch.ragged = ragged;
    patch.seen = std::move(plane.seen);
  }
}

// Collects the planes that the leaves below a square see, with their hits. Returns whether a leaf
// is ragged.
bool Survey::gatherPlanes(int32_t index, std::vector<SeenPlane>& planes) const {
  const Square& square = at(index);
  if (square.children >= 0) {
    bool ragged = false;
    for (int32_t i = 0; i < 16; ++i) ragged |= gatherPlanes(square.children + i, planes);
    return ragged;
  }
  const Sample& seen = seenBy(square).sample;
  if (!inRange(seen)) return square.ragged;
  auto known = std::ranges::find_if(planes, [&](const SeenPlane& plane) {
    return sspm::serves(plane.sample->plane, seen.at, seen.plane, frame_.bias);
  });
  if (known == planes.end()) known = planes.insert(planes.end(), {&seen, {}});
  known->seen.push_back(seen.at);
  return square.ragged;
}

Patch Survey::patchOf(const Square& square, const glm::vec4& plane) const {
  Patch patch;
  patch.plane = plane;
  // Largest distance at which a slope of the square leaves the cylinder.
  const glm::vec2 nearest = glm::max(glm::abs(square.centre) - square.size / 2, 0.0f);
  const float farthest =
      std::min(exitOf(frame_, slopeOf(frame_, nearest)), 2 * frame_.range / frame_.slope);
  const auto put = [&](glm::vec2 offset) {
    const glm::vec2 slope = slopeOf(frame_, square.centre + square.size * offset);
    const glm::vec3 along = alongSlope(frame_, slope);
    const float facing = glm::dot(glm::vec3(plane), along);
    const float t = facing < 0 ? plane.w / facing : 2 * farthest;
    patch.whole = patch.whole && t <= std::min(exitOf(frame_, slope), farthest);
    return glm::clamp(t, 0.0f, farthest) * along;
  };
  for (int i = 0; i < 4; ++i) {
    patch.corners[i] = put({(i & 1) != 0 ? 0.5f : -0.5f, (i & 2) != 0 ? 0.5f : -0.5f});
  }
  patch.centre = put(glm::vec2(0));
  return patch;
}

uint32_t Survey::planeWord(const glm::vec4& plane, ShotMap& map) {
  const std::array<uint32_t, 4> bits = {
      std::bit_cast<uint32_t>(plane.x), std::bit_cast<uint32_t>(plane.y),
      std::bit_cast<uint32_t>(plane.z), std::bit_cast<uint32_t>(plane.w)};
  const uint64_t hash = (bits[0] * 0x9E3779B97F4A7C15ull) ^ (bits[1] * 0xC2B2AE3D27D4EB4Full) ^
                        (bits[2] * 0x165667B19E3779F9ull) ^ bits[3];
  const auto [place, added] = planes_.try_emplace(hash, 0);
  if (added) {
    place->second = kPlane | static_cast<uint32_t>(map.blocks.size() / 4);
    map.blocks.insert(map.blocks.end(), bits.begin(), bits.end());
  }
  return place->second;
}

// Whether one plane serves all leaves below a square: that of `leaf`, or if null, of the first leaf
// with a hit, to which it sets `leaf`. smooth: also requires that no leaf is at an edge.
bool Survey::serves(int32_t index, const Square*& leaf, bool smooth) const {
  const Square& square = at(index);
  if (square.children < 0) {
    if (smooth && (square.edge || square.beside >= 0)) return false;
    if (!square.sample.hit) return leaf == nullptr || planePastExit(square, leaf->sample.plane);
    if (leaf == nullptr) leaf = &square;
    return sspm::serves(leaf->sample.plane, square.sample.at, square.sample.plane, frame_.bias);
  }
  for (int32_t i = 0; i < 16; ++i) {
    if (!serves(square.children + i, leaf, smooth)) return false;
  }
  return true;
}

// Two passes: the first does not compare the open squares before the first hit with its plane.
bool Survey::uniform(int32_t index, const Square*& leaf, bool smooth) const {
  leaf = nullptr;
  return serves(index, leaf, smooth) && serves(index, leaf, smooth);
}

ShotMap Survey::map() {
  ShotMap map;
  planes_.clear();
  map.root = write(0, map);
  return map;
}

uint32_t Survey::write(int32_t index, ShotMap& map) {
  const Square* leaf = nullptr;
  const auto wordOf = [&](const Square* known) {
    return known == nullptr ? kOpen : planeWord(known->sample.plane, map);
  };
  if (uniform(index, leaf, false)) return wordOf(leaf);
  std::array<uint32_t, 16> words{};
  bool leaves = true;
  std::vector<const Square*> planes;  // planes of the children written so far
  for (int32_t i = 0; i < 16; ++i) {
    uint32_t& word = words[static_cast<size_t>(i)];
    const int32_t child = at(index).children + i;
    if (!uniform(child, leaf, false)) {
      word = write(child, map);
      leaves = false;
      continue;
    }
    const auto known = std::ranges::find_if(
        planes, [&](const Square* plane) { return serves(child, plane, false); });
    if (known != planes.end()) {
      leaf = *known;
    } else if (leaf != nullptr) {
      planes.push_back(leaf);
    }
    word = wordOf(leaf);
  }
  const uint32_t first = words[0];
  const auto other = std::ranges::find_if(words, [&](uint32_t word) { return word != first; });
  const bool two = leaves && std::ranges::all_of(words, [&](uint32_t word) {
                     return word == first || (other != words.end() && word == *other);
                   });
  if (two && other != words.end()) {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < 16; ++i) bits |= words[i] == *other ? 1u << i : 0u;
    const auto block = static_cast<uint32_t>(map.blocks.size() / 4);
    map.blocks.insert(map.blocks.end(), {bits, first, *other, 0u});
    return kSplit | block;
  }
  const auto node = static_cast<uint32_t>(map.blocks.size() / 4);
  map.blocks.insert(map.blocks.end(), words.begin(), words.end());
  return kNode | node;
}

}  // namespace grisaille::sspm
