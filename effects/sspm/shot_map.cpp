// SPDX-License-Identifier: MIT
#include "shot_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace grisaille::sspm {
namespace {

constexpr float kFinestMetres = 0.004f;  // squares are split while they are wider on the surface
constexpr float kFinestUnits = 1.0f / 256;
constexpr float kInnerUnits = 1.0f / 16;  // every square within a unit of the centre is this fine
constexpr float kMiddleUnits = 1.0f / 4;  // and within three units
constexpr float kBiasUnits = 0.02f;       // of the range
// As in shaders/sspm/surface.comp. Cosines between facets: below kOther another surface, which has
// but a share of the bias, above kSame the same.
constexpr float kSlant = 8;  // biases along the ray
constexpr float kOther = -0.5f, kSame = 0.3f, kLeastBias = 0.05f;
constexpr glm::vec2 kAround[] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                 {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
constexpr float kAside = 0.6f;    // of a square, from its centre to the ones around
constexpr float kBeyond = 1.02f;  // of the range: hits past it are out of the cylinder

glm::vec2 slopeOf(const ShotFrame& frame, glm::vec2 place) {
  const float radius = glm::length(place);
  if (radius <= 1) return place * frame.slope;
  return place * (frame.slope * std::exp(radius - 1) / radius);
}

glm::vec3 alongSlope(const ShotFrame& frame, glm::vec2 slope) {
  return slope.x * frame.right + slope.y * frame.up + frame.direction;
}

// How far along `direction`, in metres before the muzzle, a slope leaves the cylinder.
float exitOf(const ShotFrame& frame, glm::vec2 slope) {
  const float length = glm::length(slope);
  return length > 0 ? kBeyond * frame.range / length : std::numeric_limits<float>::infinity();
}

struct Sample {
  bool hit = false;
  glm::vec4 plane = glm::vec4(0);  // normal, product
  glm::vec3 at = glm::vec3(0);     // offset of the hit
};

// A square of the map while it is made.
struct Square {
  glm::vec2 centre;
  float size;
  int32_t children = -1;  // index of the first of 16
  Sample sample;
  bool ragged = false;
};

class Builder {
 public:
  Builder(const CastRays& cast, ShotMap& map) : cast_(cast), map_(map), frame_(map.frame) {}

  MapState run() {
    if (const MapState state = findFarthest(); state != MapState::kSeen) return state;
    squares_.push_back({.centre = glm::vec2(0), .size = 2 * kMapReach, .sample = {}});
    std::vector<int32_t> fresh;
    lay(0, fresh);
    for (;;) {
      if (const MapState state = cast(fresh); state != MapState::kSeen) return state;
      const std::vector<int32_t> edges = findEdges(fresh);
      if (edges.empty()) break;
      fresh.clear();
      for (const int32_t edge : edges) split(edge, fresh);
    }
    gatherPatches();
    map_.root = write(0);
    return MapState::kSeen;
  }

 private:
  // The farthest surface that lies in the cylinder, as far as some rays about the axis tell.
  MapState findFarthest() {
    float farthest = 64 * frame_.range;
    for (int round = 0; round < 6; ++round) {
      frame_.slope = frame_.range / farthest;
      std::vector<Square> probes = {{.centre = glm::vec2(0), .size = 0, .sample = {}}};
      for (const float radius : {0.3f, 0.65f, 0.95f}) {
        for (int i = 0; i < 8; ++i) {
          const float angle = (static_cast<float>(i) + radius) * 0.785398f;
          probes.push_back({.centre = radius * glm::vec2(std::cos(angle), std::sin(angle)),
                            .size = 0,
                            .sample = {}});
        }
      }
      std::swap(squares_, probes);
      std::vector<int32_t> all(squares_.size());
      for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int32_t>(i);
      const MapState state = cast(all);
      std::swap(squares_, probes);
      if (state != MapState::kSeen) return state;
      float found = 0;
      for (const Square& probe : probes) {
        if (inRange(probe.sample)) {
          found = std::max(found, glm::dot(probe.sample.at, frame_.direction));
        }
      }
      const bool first = round == 0;
      if (found <= 0 || (!first && found < 1.25f * farthest)) break;
      farthest = found;
    }
    frame_.slope = frame_.range / farthest;
    frame_.bias = kBiasUnits * frame_.range + 2e-5f * farthest;
    return MapState::kSeen;
  }

  bool inRange(const Sample& sample) const {
    if (!sample.hit) return false;
    const float along = glm::dot(sample.at, frame_.direction);
    return glm::length(sample.at - along * frame_.direction) < frame_.range * kBeyond;
  }

  void addChildren(int32_t parent) {
    const glm::vec2 centre = squares_[static_cast<size_t>(parent)].centre;
    const float size = squares_[static_cast<size_t>(parent)].size / 4;
    squares_[static_cast<size_t>(parent)].children = static_cast<int32_t>(squares_.size());
    for (int i = 0; i < 16; ++i) {
      const glm::vec2 step(static_cast<float>(i % 4) - 1.5f, static_cast<float>(i / 4) - 1.5f);
      squares_.push_back({.centre = centre + size * step, .size = size, .sample = {}});
    }
  }

  // The squares that every map has; the undivided ones join `fresh`.
  void lay(int32_t index, std::vector<int32_t>& fresh) {
    const Square square = squares_[static_cast<size_t>(index)];
    const float nearest = glm::length(glm::max(glm::abs(square.centre) - square.size / 2, 0.0f));
    const float wanted = nearest < 1 ? kInnerUnits : nearest < 3 ? kMiddleUnits : 1.0f;
    if (square.size <= wanted * 1.01f) {
      fresh.push_back(index);
      return;
    }
    addChildren(index);
    const int32_t first = squares_[static_cast<size_t>(index)].children;
    for (int32_t i = 0; i < 16; ++i) lay(first + i, fresh);
  }

  void split(int32_t index, std::vector<int32_t>& fresh) {
    addChildren(index);
    const int32_t first = squares_[static_cast<size_t>(index)].children;
    for (int32_t i = 0; i < 16; ++i) fresh.push_back(first + i);
  }

  MapState cast(const std::vector<int32_t>& which) {
    std::vector<grisaille_ray> rays(which.size());
    std::vector<grisaille_hit> hits(which.size());
    for (size_t i = 0; i < which.size(); ++i) {
      const glm::vec2 slope = slopeOf(frame_, squares_[static_cast<size_t>(which[i])].centre);
      const glm::vec3 along = alongSlope(frame_, slope);
      const float length = glm::length(along);
      const glm::vec3 unit = along / length;
      rays[i] = {.origin = {frame_.origin.x, frame_.origin.y, frame_.origin.z},
                 .direction = {unit.x, unit.y, unit.z},
                 .reach = exitOf(frame_, slope) * length};
    }
    if (!cast_(rays, hits)) return MapState::kNoRays;
    for (size_t i = 0; i < which.size(); ++i) {
      if (hits[i].kind == GRISAILLE_HIT_UNKNOWN) return MapState::kUnknown;
      Sample& sample = squares_[static_cast<size_t>(which[i])].sample;
      sample.hit = hits[i].kind == GRISAILLE_HIT_SURFACE;
      if (!sample.hit) continue;
      const glm::vec3 normal(hits[i].normal[0], hits[i].normal[1], hits[i].normal[2]);
      sample.at = hits[i].distance *
                  glm::vec3(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
      sample.plane = glm::vec4(normal, glm::dot(normal, sample.at));
    }
    return MapState::kSeen;
  }

  int32_t leafAt(glm::vec2 place) const {
    int32_t index = 0;
    while (squares_[static_cast<size_t>(index)].children >= 0) {
      const Square& square = squares_[static_cast<size_t>(index)];
      const glm::vec2 corner = square.centre - square.size / 2;
      const glm::ivec2 step = glm::clamp(glm::ivec2(4.0f * (place - corner) / square.size),
                                         glm::ivec2(0), glm::ivec2(3));
      index = square.children + step.y * 4 + step.x;
    }
    return index;
  }

  // Whether `plane`, met in the slope of a square that saw nothing, lies past the cylinder's end.
  bool planePastExit(const Square& open, const glm::vec4& plane) const {
    const glm::vec2 slope = slopeOf(frame_, open.centre);
    const glm::vec3 along = alongSlope(frame_, slope);
    const float facing = glm::dot(glm::vec3(plane), along);
    return facing >= 0 || plane.w / facing >= 0.98f * frame_.range / glm::length(slope);
  }

  // Whether one surface may go on from one square into the other.
  bool agree(const Square& a, const Square& b) const {
    if (!a.sample.hit && !b.sample.hit) return true;
    if (!a.sample.hit) return planePastExit(a, b.sample.plane);
    if (!b.sample.hit) return planePastExit(b, a.sample.plane);
    return onPlane(a.sample.plane, b.sample.at) && onPlane(b.sample.plane, a.sample.at);
  }
  bool onPlane(const glm::vec4& plane, const glm::vec3& at) const {
    return std::abs(glm::dot(glm::vec3(plane), at) - plane.w) <= 0.8f * frame_.bias;
  }

  // The squares to split, after `fresh` were cast: those between surfaces that are wider than need
  // be. Both sides of an edge are told of it.
  std::vector<int32_t> findEdges(const std::vector<int32_t>& fresh) {
    std::vector<int32_t> edges;
    const auto tell = [&](int32_t index) {
      Square& square = squares_[static_cast<size_t>(index)];
      if (!square.ragged && !isFine(square)) edges.push_back(index);
      square.ragged = true;
    };
    for (const int32_t index : fresh) {
      const Square& square = squares_[static_cast<size_t>(index)];
      for (const glm::vec2 side : kAround) {
        const glm::vec2 place = square.centre + side * (square.size * kAside);
        if (std::max(std::abs(place.x), std::abs(place.y)) >= kMapReach) continue;
        const int32_t other = leafAt(place);
        if (agree(square, squares_[static_cast<size_t>(other)])) continue;
        tell(index);
        tell(other);
      }
    }
    return edges;
  }

  bool isFine(const Square& square) const {
    return square.size <= kFinestUnits || square.size * frame_.range <= kFinestMetres ||
           (square.size <= kInnerUnits && glm::length(square.centre) > 4);
  }

  void gatherPatches() {
    for (const Square& square : squares_) {
      if (square.children >= 0 || !inRange(square.sample)) continue;
      Patch patch;
      patch.hit = square.sample.at;
      patch.plane = square.sample.plane;
      patch.ragged = square.ragged;
      for (int i = 0; i < 4; ++i) {
        const glm::vec2 corner((i & 1) != 0 ? 0.5f : -0.5f, (i & 2) != 0 ? 0.5f : -0.5f);
        const glm::vec2 slope = slopeOf(frame_, square.centre + square.size * corner);
        const glm::vec3 along = alongSlope(frame_, slope);
        const float facing = glm::dot(glm::vec3(patch.plane), along);
        const float end = std::min(exitOf(frame_, slope), 2 * frame_.range / frame_.slope);
        const float t = facing < 0 ? patch.plane.w / facing : end;
        patch.corners[i] = glm::clamp(t, 0.0f, end) * along;
      }
      map_.patches.push_back(patch);
    }
  }

  uint32_t addBlock(const std::array<uint32_t, 4>& block) {
    const uint32_t index = static_cast<uint32_t>(map_.blocks.size() / 4);
    map_.blocks.insert(map_.blocks.end(), block.begin(), block.end());
    return index;
  }

  uint32_t planeWord(const glm::vec4& plane) {
    const std::array<uint32_t, 4> bits = {
        std::bit_cast<uint32_t>(plane.x), std::bit_cast<uint32_t>(plane.y),
        std::bit_cast<uint32_t>(plane.z), std::bit_cast<uint32_t>(plane.w)};
    const uint64_t hash = (bits[0] * 0x9E3779B97F4A7C15ull) ^ (bits[1] * 0xC2B2AE3D27D4EB4Full) ^
                          (bits[2] * 0x165667B19E3779F9ull) ^ bits[3];
    const auto [place, added] = planes_.try_emplace(hash, 0);
    if (added) place->second = kPlane | addBlock(bits);
    return place->second;
  }

  // The one plane that serves all leaves below a square, if there is one. `leaf` is the square
  // whose sample it is.
  bool serves(int32_t index, const Square*& leaf) const {
    const Square& square = squares_[static_cast<size_t>(index)];
    if (square.children < 0) {
      if (!square.sample.hit) return leaf == nullptr || planePastExit(square, leaf->sample.plane);
      if (leaf == nullptr) leaf = &square;
      const glm::vec4& plane = leaf->sample.plane;
      return std::abs(glm::dot(glm::vec3(plane), square.sample.at) - plane.w) <=
                 0.25f * frame_.bias &&
             glm::dot(glm::vec3(plane), glm::vec3(square.sample.plane)) > 0.98f;
    }
    for (int32_t i = 0; i < 16; ++i) {
      if (!serves(square.children + i, leaf)) return false;
    }
    return true;
  }

  // Twice, since open squares that came before the first hit were not held against its plane.
  bool uniform(int32_t index, const Square*& leaf) const {
    leaf = nullptr;
    return serves(index, leaf) && serves(index, leaf);
  }

  uint32_t write(int32_t index) {
    const Square square = squares_[static_cast<size_t>(index)];
    const Square* leaf = nullptr;
    if (uniform(index, leaf)) return leaf == nullptr ? kOpen : planeWord(leaf->sample.plane);
    std::array<uint32_t, 16> words{};
    bool leaves = true;
    std::vector<const Square*> planes;  // that serve children written so far
    for (int32_t i = 0; i < 16; ++i) {
      uint32_t& word = words[static_cast<size_t>(i)];
      const int32_t child = square.children + i;
      if (!uniform(child, leaf)) {
        word = write(child);
        leaves = false;
        continue;
      }
      const auto known =
          std::ranges::find_if(planes, [&](const Square* plane) { return serves(child, plane); });
      if (known != planes.end()) {
        leaf = *known;
      } else if (leaf != nullptr) {
        planes.push_back(leaf);
      }
      word = leaf == nullptr ? kOpen : planeWord(leaf->sample.plane);
    }
    const uint32_t first = words[0];
    const auto other = std::ranges::find_if(words, [&](uint32_t word) { return word != first; });
    const bool two = leaves && std::ranges::all_of(words, [&](uint32_t word) {
                       return word == first || (other != words.end() && word == *other);
                     });
    if (two && other != words.end()) {
      uint32_t bits = 0;
      for (uint32_t i = 0; i < 16; ++i) bits |= words[i] == *other ? 1u << i : 0u;
      return kSplit | addBlock({bits, first, *other, 0});
    }
    const uint32_t node = static_cast<uint32_t>(map_.blocks.size() / 4);
    map_.blocks.insert(map_.blocks.end(), words.begin(), words.end());
    return kNode | node;
  }

  const CastRays& cast_;
  ShotMap& map_;
  ShotFrame& frame_;
  std::vector<Square> squares_;
  std::unordered_map<uint64_t, uint32_t> planes_;
};

}  // namespace

void setAxes(ShotFrame& frame) {
  const glm::vec3& w = frame.direction;
  const float sign = w.z >= 0 ? 1.0f : -1.0f;
  const float a = -1.0f / (sign + w.z);
  const float b = w.x * w.y * a;
  frame.right = glm::vec3(1.0f + sign * w.x * w.x * a, sign * b, -sign * w.x);
  frame.up = glm::vec3(b, sign + w.y * w.y * a, -w.y);
}

glm::vec2 mapOf(const ShotFrame& frame, const glm::vec3& q) {
  const float along = std::max(glm::dot(q, frame.direction), 1e-20f);
  const glm::vec2 place =
      glm::vec2(glm::dot(q, frame.right), glm::dot(q, frame.up)) / (along * frame.slope);
  const float radius = glm::length(place);
  if (!(radius > 1)) return place;
  return place * (std::min(1.0f + std::log(radius), 0.999f * kMapReach) / radius);
}

MapState seeFrom(const grisaille_shot& shot, float range, const CastRays& cast, ShotMap& map) {
  map = {};
  map.frame.origin = glm::dvec3(shot.origin[0], shot.origin[1], shot.origin[2]);
  map.frame.direction = glm::vec3(shot.direction[0], shot.direction[1], shot.direction[2]);
  map.frame.range = range;
  setAxes(map.frame);
  return Builder(cast, map).run();
}

bool inSight(const ShotFrame& frame, uint32_t root, const uint32_t* blocks, const glm::vec3& q,
             const glm::vec3& facing) {
  const glm::vec2 place = mapOf(frame, q);
  glm::vec2 at = (place + kMapReach) * (2.0f / kMapReach);  // in squares of the root's 4x4
  uint32_t word = root;
  while ((word & kNode) != 0) {
    const glm::vec2 square = glm::clamp(glm::floor(at), 0.0f, 3.0f);
    const uint32_t bit = static_cast<uint32_t>(square.y) * 4 + static_cast<uint32_t>(square.x);
    const uint32_t* block = blocks + size_t{word & ~kTag} * 4;
    word = (word & kTag) == kNode ? block[bit] : block[1 + (block[0] >> bit & 1u)];
    at = (at - square) * 4.0f;
  }
  if (word == kOpen) return true;
  const uint32_t* plane = blocks + size_t{word & ~kTag} * 4;
  const glm::vec3 normal(std::bit_cast<float>(plane[0]), std::bit_cast<float>(plane[1]),
                         std::bit_cast<float>(plane[2]));
  const float behind = std::bit_cast<float>(plane[3]) - glm::dot(normal, q);
  // A point of the same surface may lie a little behind the plane of the facet beside it; one that
  // faces elsewhere may not. Seen at a slant, a little is much along the ray.
  const float bias = frame.bias * glm::clamp((glm::dot(normal, facing) - kOther) / (kSame - kOther),
                                             kLeastBias, 1.0f);
  return behind <= bias && behind * glm::length(q) <= kSlant * bias * std::abs(glm::dot(normal, q));
}

}  // namespace grisaille::sspm
