// SPDX-License-Identifier: MIT
// What a survey found: patches of surfaces, and the map.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "survey.h"
#include "survey_slopes.h"

namespace grisaille::sspm {
namespace {

constexpr int32_t kPatchSize = kFinestAUnit / 4;  // width of the largest patch
constexpr int32_t kMixedSize = kFinestAUnit / 8;  // of a square with several planes

// A plane far enough behind the muzzle that it hides everything.
glm::vec4 hidingPlane(const ShotFrame& frame) {
  return glm::vec4(roundedNormal(-frame.direction), 2 * frame.bias);
}

}  // namespace

std::vector<Patch> Survey::patches() const {
  std::vector<Patch> result;
  if (stage_ != Stage::kProbing) gatherPatches(0, result);
  return result;
}

void Survey::gatherPatches(int32_t index, std::vector<Patch>& patches) const {
  const Square& square = at(index);
  if (square.kind == Kind::kNothing || square.kind == Kind::kUntold) return;
  const Sample* plane = nullptr;
  if (square.size <= kPatchSize && uniform(index, plane)) {
    if (plane == nullptr) return;
    const Patch patch = patchOf(square, plane->plane);
    if (patch.whole || square.kind == Kind::kOnePlane) {
      patches.push_back(patch);
      return;
    }
  }
  if (square.kind == Kind::kOnePlane) {
    patches.push_back(patchOf(square, sample(square.first).plane));
    return;
  }
  if (square.kind == Kind::kDivided && square.size > kMixedSize) {
    for (int32_t i = 0; i < 4; ++i) gatherPatches(square.children + i, patches);
    return;
  }
  std::vector<SeenPlane> planes;
  bool ragged = false;
  gatherPlanes(index, planes, ragged);
  for (SeenPlane& seen : planes) {
    Patch& patch = patches.emplace_back(patchOf(square, seen.sample->plane));
    patch.centre = seen.seen.front();
    patch.ragged = ragged;
    patch.seen = std::move(seen.seen);
  }
}

// Collects the planes that the leaves below a square see, with points on them. Sets `ragged` if a
// leaf is.
void Survey::gatherPlanes(int32_t index, std::vector<SeenPlane>& planes, bool& ragged) const {
  const Square& square = at(index);
  ragged = ragged || square.ragged;
  const auto see = [&](const Sample& seen, const glm::vec3& point) {
    if (!(frame_.across(point) < frame_.range * kBeyond)) return;
    auto known = std::ranges::find_if(planes, [&](const SeenPlane& plane) {
      return sspm::serves(plane.sample->plane, point, seen.plane, frame_.bias);
    });
    if (known == planes.end()) known = planes.insert(planes.end(), {&seen, {}});
    known->seen.push_back(point);
  };
  if (square.kind == Kind::kDivided) {
    for (int32_t i = 0; i < 4; ++i) gatherPlanes(square.children + i, planes, ragged);
  } else if (square.kind == Kind::kTwoPlanes) {
    // Each plane at those of nine places that are on its side.
    for (int i = 0; i < 9; ++i) {
      const glm::vec2 step(static_cast<float>(i % 3), static_cast<float>(i / 3));
      const glm::vec2 place = unitsOf(square.corner) + step * (sizeOf(square) / 2);
      const bool second = glm::dot(square.line.normal, place) > square.line.offset;
      const Sample& seen = sample(second ? square.second : square.first);
      const glm::vec3 along = alongSlope(frame_, slopeOf(frame_, place));
      const float facing = glm::dot(glm::vec3(seen.plane), along);
      if (facing < 0 && seen.plane.w < 0) see(seen, along * (seen.plane.w / facing));
    }
    see(sample(square.first), sample(square.first).at);
    see(sample(square.second), sample(square.second).at);
  } else if (square.kind == Kind::kOnePlane || square.kind == Kind::kSeveral) {
    for (const int32_t corner : square.corners) {
      if (sample(corner).hit) see(sample(corner), sample(corner).at);
    }
  }
}

Patch Survey::patchOf(const Square& square, const glm::vec4& plane) const {
  Patch patch;
  patch.plane = plane;
  // Largest distance at which a slope of the square leaves the cylinder; near the axis, several
  // times that of the farthest hit, since rays miss where grazed surfaces end.
  const glm::vec2 centre = centreOf(square);
  const float size = sizeOf(square);
  const glm::vec2 nearest = glm::max(glm::abs(centre) - size / 2, 0.0f);
  const float farthest =
      std::min(exitOf(frame_, slopeOf(frame_, nearest)), 8 * frame_.range / frame_.slope);
  const auto put = [&](const glm::vec2& offset) {
    const glm::vec2 slope = slopeOf(frame_, centre + size * offset);
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

// Whether one plane serves all leaves below a square: `plane`, or if null, the first one, to which
// it sets `plane`.
bool Survey::serves(int32_t index, const Sample*& plane) const {
  const Square& square = at(index);
  switch (square.kind) {
    case Kind::kNothing:
      return true;
    case Kind::kOnePlane:
      if (plane == nullptr) plane = &sample(square.first);
      return std::ranges::all_of(square.corners, [&](int32_t corner) {
        return !sample(corner).hit ||
               sspm::serves(plane->plane, sample(corner).at, sample(corner).plane, frame_.bias);
      });
    case Kind::kDivided:
      for (int32_t i = 0; i < 4; ++i) {
        if (!serves(square.children + i, plane)) return false;
      }
      return true;
    default:
      return false;
  }
}

bool Survey::uniform(int32_t index, const Sample*& plane) const {
  plane = nullptr;
  return serves(index, plane);
}

// Writes the map, from the tree's squares of every second size.
class Survey::Writer {
 public:
  explicit Writer(const Survey& survey) : survey_(survey) {}

  ShotMap write() {
    map_.root = write(0);
    return std::move(map_);
  }

 private:
  uint32_t add(std::span<const uint32_t> words) {
    const size_t block = map_.words.size() / 2;
    if (block + words.size() / 2 > kMostBlocks) return 0;
    map_.words.insert(map_.words.end(), words.begin(), words.end());
    return static_cast<uint32_t>(block);
  }

  uint32_t plane(const glm::vec4& plane) {
    const MapBlock block = packPlane(plane);
    for (const uint32_t known : planes_) {
      const uint32_t* words = map_.words.data() + size_t{known - 1} * 2;
      if (words[0] == block[0] && words[1] == block[1]) return known;
    }
    planes_.push_back(add(block) + 1);
    return planes_.back();
  }

  // Reference to a plane that serves all of a square, if it may be one that the map has already.
  uint32_t planeFor(int32_t index, const Sample& wanted) {
    for (const Sample* known : served_) {
      const Sample* plane = known;
      if (survey_.serves(index, plane)) return this->plane(known->plane);
    }
    served_.push_back(&wanted);
    if (served_.size() > 4) served_.erase(served_.begin());
    return plane(wanted.plane);
  }

  // Whether a square is not divided in the map; `reference` gets what it is.
  bool isLeaf(int32_t index, uint32_t& reference) {
    const Square& square = survey_.at(index);
    const Sample* known = nullptr;
    if (!(square.kind == Kind::kOnePlane && square.shift > 0.25f * survey_.frame_.bias) &&
        survey_.uniform(index, known)) {
      reference = known == nullptr ? kOpen : planeFor(index, *known);
      return true;
    }
    switch (square.kind) {
      case Kind::kDivided:
        return false;
      case Kind::kTwoPlanes: {
        const uint32_t first = plane(survey_.sample(square.first).plane);
        const uint32_t second = plane(survey_.sample(square.second).plane);
        reference = first == second ? first : kLine | add(packLine(square.line, first, second));
        return true;
      }
      case Kind::kUntold:
        reference = plane(hidingPlane(survey_.frame_));
        return true;
      default:
        reference = plane(survey_.sample(square.first).plane - glm::vec4(0, 0, 0, square.shift));
        return true;
    }
  }

  uint32_t write(int32_t index) {
    uint32_t reference = kOpen;
    if (isLeaf(index, reference)) return reference;
    std::array<uint32_t, 16> squares{};
    for (int32_t i = 0; i < 4; ++i) {
      const int32_t child = survey_.at(index).children + i;
      const bool leaf = isLeaf(child, reference);
      for (int32_t j = 0; j < 4; ++j) {
        const int32_t x = 2 * (i & 1) + (j & 1), y = (i & 2) + (j >> 1);
        squares[4 * static_cast<size_t>(y) + static_cast<size_t>(x)] =
            leaf ? reference : write(survey_.at(child).children + j);
      }
    }
    return node(squares);
  }

  uint32_t node(const std::array<uint32_t, 16>& squares) {
    const uint32_t first = squares[0];
    const auto other = std::ranges::find_if(squares, [&](uint32_t it) { return it != first; });
    if (other == squares.end()) return first;
    if (std::ranges::all_of(squares, [&](uint32_t it) { return it == first || it == *other; })) {
      uint32_t bits = 0;
      for (size_t i = 0; i < 16; ++i) bits |= squares[i] == *other ? 1u << i : 0u;
      return kSplit | add(MapBlock{bits | first << 16, *other});
    }
    std::array<uint32_t, 8> words;
    for (size_t i = 0; i < 8; ++i) words[i] = squares[2 * i] | squares[2 * i + 1] << 16;
    return kNode | add(words);
  }

  const Survey& survey_;
  ShotMap map_;
  std::vector<uint32_t> planes_;       // references
  std::vector<const Sample*> served_;  // planes of the last squares
};

ShotMap Survey::map() const {
  return Writer(*this).write();
}

}  // namespace grisaille::sspm
