// SPDX-License-Identifier: MIT
// What a survey found: the patches of the visible surfaces, and the map.
#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "survey.h"

namespace grisaille::sspm {
namespace {

constexpr float kPatchUnits = 1.0f / 4;  // width of the largest patch

}  // namespace

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
    for (int32_t i = 0; i < 4; ++i) gatherPatches(square.children + i, patches);
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
    for (int32_t i = 0; i < 4; ++i) ragged |= gatherPlanes(square.children + i, planes);
    return ragged;
  }
  const auto add = [&](const Sample& seen) {
    if (!inRange(seen)) return;
    auto known = std::ranges::find_if(planes, [&](const SeenPlane& plane) {
      return sspm::serves(plane.sample->plane, seen.at, seen.plane, frame_.bias);
    });
    if (known == planes.end()) known = planes.insert(planes.end(), {&seen, {}});
    known->seen.push_back(seen.at);
  };
  add(seenBy(square).sample);
  for (const int32_t crease : square.creases) {
    if (crease >= 0) add(at(crease).sample);
  }
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
  for (int32_t i = 0; i < 4; ++i) {
    if (!serves(square.children + i, leaf, smooth)) return false;
  }
  return true;
}

// Two passes: the first does not compare the open squares before the first hit with its plane.
bool Survey::uniform(int32_t index, const Square*& leaf, bool smooth) const {
  leaf = nullptr;
  return serves(index, leaf, smooth) && serves(index, leaf, smooth);
}

// Collects the planes of all surfaces in a square, and of those that reach into it over a ridge.
// What reaches into it from a valley lies in front of the square's own plane, and needs no plane.
// False if more than kMostPlanes, or if a point may be in front of one plane and hidden all the
// same: in a valley, beside an edge or a depth discontinuity.
bool Survey::gatherSurfaces(int32_t index, Planes& planes) const {
  const Square& square = at(index);
  if (square.children >= 0) {
    bool meet = true;
    for (int32_t i = 0; i < 4 && planes.size() <= kMostPlanes; ++i) {
      meet &= gatherSurfaces(square.children + i, planes);
    }
    return meet && planes.size() <= kMostPlanes;
  }
  const auto add = [&](const Sample& sample) {
    const bool known = std::ranges::any_of(planes, [&](const glm::vec4& plane) {
      return sspm::serves(plane, sample.at, sample.plane, frame_.bias);
    });
    if (!known) planes.push_back(sample.plane);
  };
  if (square.sample.hit) add(square.sample);
  for (size_t i = 0; i < square.creases.size(); ++i) {
    if ((square.ridges >> i & 1) != 0) add(at(square.creases[i]).sample);
  }
  return !square.ragged && !square.valley && square.sample.hit;
}

// Whether a word without children tells what the muzzle sees in a square. planes: gets its planes.
bool Survey::fitsOneWord(int32_t index, Planes& planes) const {
  planes.clear();
  const bool meet = gatherSurfaces(index, planes);
  if (planes.size() > kMostPlanes) return false;
  const Square* leaf = nullptr;
  return at(index).children < 0 || meet || (planes.size() <= 1 && uniform(index, leaf, false));
}

ShotMap Survey::map() {
  ShotMap map;
  words_.clear();
  map.root = write(0, map);
  return map;
}

// A word for a block of the map, which equal blocks share.
uint32_t Survey::blockWord(const std::array<uint32_t, 4>& block, ShotMap& map) {
  const uint64_t hash = (block[0] * 0x9E3779B97F4A7C15ull) ^ (block[1] * 0xC2B2AE3D27D4EB4Full) ^
                        (block[2] * 0x165667B19E3779F9ull) ^ block[3];
  const auto [place, added] = words_.try_emplace(hash, 0);
  if (added) {
    place->second = static_cast<uint32_t>(map.blocks.size() / 4);
    map.blocks.insert(map.blocks.end(), block.begin(), block.end());
  }
  return place->second;
}

uint32_t Survey::wordOf(const Planes& planes, ShotMap& map) {
  if (planes.empty()) return kOpen;
  std::array<uint32_t, kMostPlanes> words{};
  for (size_t i = 0; i < planes.size(); ++i) {
    const glm::vec4& plane = planes[i];
    words[i] =
        kPlane | blockWord({std::bit_cast<uint32_t>(plane.x), std::bit_cast<uint32_t>(plane.y),
                            std::bit_cast<uint32_t>(plane.z), std::bit_cast<uint32_t>(plane.w)},
                           map);
  }
  if (planes.size() == 1) return words[0];
  std::ranges::sort(words, std::greater<>());
  return kSeveral + blockWord(words, map);
}

uint32_t Survey::write(int32_t index, ShotMap& map) {
  Planes planes;
  if (fitsOneWord(index, planes)) return wordOf(planes, map);
  std::array<uint32_t, 16> words{};
  bool leaves = true;
  std::vector<glm::vec4> known;  // planes of the children written so far
  const auto one = [&](int32_t child) {
    if (planes.size() == 1) {
      const auto same = std::ranges::find_if(known, [&](const glm::vec4& plane) {
        Square leaf;
        leaf.sample = {.hit = true, .plane = plane};
        const Square* it = &leaf;
        return serves(child, it, false);
      });
      if (same != known.end()) {
        planes[0] = *same;
      } else {
        known.push_back(planes[0]);
      }
    }
    return wordOf(planes, map);
  };
  for (int32_t i = 0; i < 4; ++i) {
    const int32_t quarter = at(index).children + i;
    const bool whole = fitsOneWord(quarter, planes);
    const uint32_t word = whole ? one(quarter) : 0;
    for (int32_t k = 0; k < 4; ++k) {
      uint32_t& place = words[static_cast<size_t>((i / 2 * 2 + k / 2) * 4 + i % 2 * 2 + k % 2)];
      if (whole) {
        place = word;
        continue;
      }
      const int32_t child = at(quarter).children + k;
      const bool fits = fitsOneWord(child, planes);
      place = fits ? one(child) : write(child, map);
      leaves = leaves && fits;
    }
  }
  const uint32_t first = words[0];
  const auto other = std::ranges::find_if(words, [&](uint32_t word) { return word != first; });
  if (other == words.end() && leaves) return first;
  const bool two = leaves && std::ranges::all_of(words, [&](uint32_t word) {
                     return word == first || word == *other;
                   });
  if (two) {
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
