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
constexpr size_t kRecent = 16;                    // planes that a leaf may share
// Of a square's width: how far a line may be from the one for which it stands.
constexpr float kLineMerges = 0.05f;
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

// Whether a plane serves all leaves below a square.
bool Survey::serves(int32_t index, const glm::vec4& plane) const {
  const Square& square = at(index);
  switch (square.kind) {
    case Kind::kNothing:
      return true;
    case Kind::kOnePlane:
      return std::ranges::all_of(square.corners, [&](int32_t corner) {
        return !sample(corner).hit ||
               sspm::serves(plane, sample(corner).at, sample(corner).plane, frame_.bias);
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

const Survey::Sample* Survey::firstPlane(int32_t index) const {
  const Square& square = at(index);
  if (square.kind == Kind::kOnePlane) return &sample(square.first);
  const Sample* first = nullptr;
  for (int32_t i = 0; i < 4 && square.kind == Kind::kDivided && first == nullptr; ++i) {
    first = firstPlane(square.children + i);
  }
  return first;
}

// Whether one plane serves all leaves below a square: that of `first`, which it sets. Null: no
// surface.
bool Survey::uniform(int32_t index, const Sample*& first) const {
  first = firstPlane(index);
  return serves(index, first == nullptr ? glm::vec4(0) : first->plane);
}

// Writes the map, from the tree's squares of every second size.
class Survey::Writer {
 public:
  // least: width of a square that is a leaf, whatever it sees; in finest squares.
  Writer(const Survey& survey, int32_t least) : survey_(survey), least_(least) {}

  ShotMap write() {
    map_.root = write(0);
    return std::move(map_);
  }
  bool isFull() const { return full_; }

 private:
  uint32_t add(std::span<const uint32_t> words) {
    const size_t block = map_.words.size() / 2;
    full_ = full_ || block + words.size() / 2 > kMostBlocks;
    if (full_) return 0;
    map_.words.insert(map_.words.end(), words.begin(), words.end());
    return static_cast<uint32_t>(block);
  }

  // Reference to a plane. Adds it to the map unless the map has it.
  uint32_t plane(const glm::vec4& plane) {
    const MapBlock block = packPlane(plane);
    for (const uint32_t known : planes_) {
      const uint32_t* words = map_.words.data() + size_t{known - 1} * 2;
      if (words[0] == block[0] && words[1] == block[1]) return known;
    }
    planes_.push_back(add(block) + 1);
    return planes_.back();
  }

  // Reference to `wanted`, or to one of the last planes if `fits` it.
  template <typename Fits>
  uint32_t planeFor(const glm::vec4& wanted, const Fits& fits) {
    for (size_t i = recent_.size(); i-- > 0;) {
      if (!fits(recent_[i])) continue;
      const glm::vec4 used = recent_[i];
      recent_.erase(recent_.begin() + static_cast<std::ptrdiff_t>(i));
      recent_.push_back(used);
      return plane(used);
    }
    if (recent_.size() >= kRecent) recent_.erase(recent_.begin());
    recent_.push_back(wanted);
    return plane(wanted);
  }

  // Reference to a plane for the corners of a square that see one of its planes.
  // side: of the square's line; 0: both sides.
  uint32_t planeFor(const Square& square, const glm::vec4& wanted, float side) {
    return planeFor(wanted, [&](const glm::vec4& plane) {
      return std::ranges::all_of(square.corners, [&](int32_t index) {
        const Sample& corner = survey_.sample(index);
        const float off = glm::dot(square.line.normal, unitsOf(corner.place)) - square.line.offset;
        if (!corner.hit || off * side < 0) return true;
        return sspm::serves(plane, corner.at, corner.plane, survey_.frame_.bias);
      });
    });
  }

  // Whether a square is not divided in the map; `reference` gets what it is.
  bool isLeaf(int32_t index, uint32_t& reference) {
    const Square& square = survey_.at(index);
    const Sample* first = nullptr;
    if (!(square.kind == Kind::kOnePlane && square.shift > 0.25f * survey_.frame_.bias) &&
        survey_.uniform(index, first)) {
      reference = first == nullptr ? kOpen : planeFor(first->plane, [&](const glm::vec4& plane) {
        return survey_.serves(index, plane);
      });
      return true;
    }
    switch (square.kind) {
      case Kind::kDivided:
        first = square.size <= least_ ? survey_.firstPlane(index) : nullptr;
        if (first != nullptr) reference = plane(first->plane);
        return first != nullptr;
      case Kind::kTwoPlanes: {
        const uint32_t far = planeFor(square, survey_.sample(square.first).plane, -1);
        const uint32_t near = planeFor(square, survey_.sample(square.second).plane, 1);
        reference = far == near ? far : lineFor(square, far, near);
        return true;
      }
      case Kind::kOnePlane:
        reference = planeFor(square, shifted(square), 0);
        return true;
      case Kind::kUntold:
        reference = plane(hidingPlane(survey_.frame_));
        return true;
      default:
        reference = plane(shifted(square));
        return true;
    }
  }

  // Reference to the line of a square with two planes, or to one of the last lines between the same
  // planes that divides the square alike.
  uint32_t lineFor(const Square& square, uint32_t far, uint32_t near) {
    const MapLine& own = square.line;
    const float size = survey_.sizeOf(square);
    const glm::vec2 corner = unitsOf(square.corner);
    const glm::vec2 along(-own.normal.y, own.normal.x);
    const glm::vec2 foot = corner + size / 2 -
                           own.normal * ((glm::dot(own.normal, corner + size / 2) - own.offset) /
                                         glm::dot(own.normal, own.normal));
    const glm::vec2 reach = along * (size / 2 / std::max(std::abs(along.x), std::abs(along.y)));
    const float most = size * kLineMerges;
    for (size_t i = lines_.size(); i-- > 0;) {
      const Line& known = lines_[i];
      if (known.far != far || known.near != near || glm::dot(known.line.normal, own.normal) < 0 ||
          std::abs(glm::dot(known.line.normal, foot - reach) - known.line.offset) > most ||
          std::abs(glm::dot(known.line.normal, foot + reach) - known.line.offset) > most) {
        continue;
      }
      return known.reference;
    }
    const uint32_t reference = kLine | add(packLine(own, far, near));
    if (lines_.size() >= kRecent) lines_.erase(lines_.begin());
    lines_.push_back({own, far, near, reference});
    return reference;
  }

  glm::vec4 shifted(const Square& square) const {
    return survey_.sample(square.first).plane - glm::vec4(0, 0, 0, square.shift);
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
    return node(survey_.at(index), squares);
  }

  // Whether the line that divides some of the squares divides all of them.
  bool isLine(const Square& square, const std::array<uint32_t, 16>& squares, uint32_t reference) {
    if (reference < kLine || (reference & kTag) != kLine) return false;
    const uint32_t* block = map_.words.data() + size_t{reference & ~kTag} * 2;
    const MapLine line = unpackLine(block);
    const float size = survey_.sizeOf(square) / 4;
    for (size_t i = 0; i < 16; ++i) {
      if (squares[i] == reference) continue;
      const bool second = squares[i] == block[0] >> 16;
      if (!second && squares[i] != (block[0] & 0xFFFFu)) return false;
      const glm::vec2 centre = unitsOf(square.corner) + (glm::vec2(i % 4, i / 4) + 0.5f) * size;
      const float off = glm::dot(line.normal, centre) - line.offset;
      // |x| + |y| = 1: half the square's extent along the normal is size / 2.
      if ((second ? off : -off) < size * (0.5f - kLineMerges)) return false;
    }
    return true;
  }

  uint32_t node(const Square& square, const std::array<uint32_t, 16>& squares) {
    for (const uint32_t reference : squares) {
      if (isLine(square, squares, reference)) return reference;
    }
    std::array<uint32_t, 16> indices;
    std::vector<uint32_t> distinct;
    for (size_t i = 0; i < 16; ++i) {
      const auto known = std::ranges::find(distinct, squares[i]);
      indices[i] = static_cast<uint32_t>(known - distinct.begin());
      if (known == distinct.end()) distinct.push_back(squares[i]);
    }
    if (distinct.size() == 1) return distinct[0];
    std::array<uint32_t, 16> halves{};
    const auto put = [&](size_t firstHalf, std::span<const uint32_t> references) {
      std::ranges::copy(references, halves.begin() + static_cast<std::ptrdiff_t>(firstHalf));
    };
    if (distinct.size() > 8) {
      put(0, squares);
      return addNode(kSixteen, halves, 4);
    }
    const uint32_t bits = distinct.size() > 4 ? 3 : distinct.size() > 2 ? 2 : 1;
    std::array<uint32_t, 2> words{};
    for (uint32_t i = 0; i < 16; ++i) {
      const bool second = bits == 3 && i >= 10;
      words[second ? 1 : 0] |= indices[i] << (bits * (second ? i - 10 : i));
    }
    halves = {words[0] & 0xFFFFu, words[0] >> 16, words[1] & 0xFFFFu, words[1] >> 16};
    put(bits == 3 ? 4 : bits, distinct);
    return bits == 3   ? addNode(kEight, halves, 3)
           : bits == 2 ? addNode(kFour, halves, 2)
                       : addNode(kTwo, halves, 1);
  }

  // Adds the blocks of a node, of four halves each. Returns the reference to it.
  uint32_t addNode(uint32_t tag, const std::array<uint32_t, 16>& halves, size_t blocks) {
    std::array<uint32_t, 8> words{};
    for (size_t i = 0; i < 2 * blocks; ++i) words[i] = halves[2 * i] | halves[2 * i + 1] << 16;
    return tag | add(std::span(words).first(2 * blocks));
  }

  struct Line {
    MapLine line;
    uint32_t far, near, reference;
  };

  const Survey& survey_;
  const int32_t least_;
  bool full_ = false;
  ShotMap map_;
  std::vector<Line> lines_;        // the last lines, newest last
  std::vector<uint32_t> planes_;   // references
  std::vector<glm::vec4> recent_;  // the last planes used, newest last
};

ShotMap Survey::map() const {
  for (int32_t least = 0;; least = std::max(2 * least, 2)) {
    Writer writer(*this, least);
    ShotMap map = writer.write();
    if (!writer.isFull()) return map;
  }
}

}  // namespace grisaille::sspm
