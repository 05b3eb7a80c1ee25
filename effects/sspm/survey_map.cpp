// SPDX-License-Identifier: MIT
// Writes the map of what a survey found.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "survey.h"
#include "survey_slopes.h"

namespace grisaille::sspm {
namespace {

constexpr size_t kRecent = 16;  // planes that a leaf may share
// Of a square's width: how far a line may be from the one for which it stands.
constexpr float kLineMerges = 0.05f;
// Of a coarse map: width of the largest squares that are leaves, in finest squares, and area of a
// leaf that its planes need not serve, square units.
constexpr int32_t kCoarseLargest = kFinestAUnit / 2;
constexpr int32_t kPieceSize = 8;  // least width of a piece of a square with two planes
constexpr float kCoarseArea = (20.0f / kFinestAUnit) * (20.0f / kFinestAUnit);

// A plane far enough behind the muzzle that it hides everything.
glm::vec4 hidingPlane(const ShotFrame& frame) {
  return glm::vec4(roundedNormal(-frame.direction), 2 * frame.bias);
}

}  // namespace

// Writes the map, from the tree's squares of every second size.
class Survey::Writer {
 public:
  // least: width of a square that is a leaf, whatever it sees; in finest squares.
  // most: area of a leaf that its planes need not serve, square units of the map; 0: exact.
  Writer(const Survey& survey, int32_t least, float most)
      : survey_(survey), least_(least), most_(most) {}

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
    const auto [known, added] = planes_.try_emplace(uint64_t{block[1]} << 32 | block[0]);
    if (added) known->second = add(block) + 1;
    return known->second;
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
    if (!(square.kind == Kind::kOnePlane && square.shift > 0.25f * survey_.frame_.bias) &&
        square.uniform != kMixed) {
      reference = kOpen;
      if (square.uniform != kEmpty) {
        reference = planeFor(survey_.sample(square.uniform).plane,
                             [&](const glm::vec4& plane) { return survey_.serves(index, plane); });
      }
      return true;
    }
    switch (square.kind) {
      case Kind::kDivided: {
        if (most_ > 0) return isCoarse(index, reference);
        const Sample* first = square.size <= least_ ? survey_.firstPlane(index) : nullptr;
        if (first != nullptr) reference = plane(first->plane);
        return first != nullptr;
      }
      case Kind::kTwoPlanes: {
        const uint32_t far = planeFor(square, survey_.sample(square.first).plane, -1);
        const uint32_t near = planeFor(square, survey_.sample(square.second).plane, 1);
        reference = far == near ? far : lineFor(square, square.line, far, near);
        return true;
      }
      case Kind::kOnePlane:
        reference = most_ == 0 && square.open ? kOpen : planeFor(square, shifted(square), 0);
        return true;
      case Kind::kUntold:
        reference = plane(hidingPlane(survey_.frame_));
        return true;
      default:
        reference = plane(shifted(square));
        return true;
    }
  }

  // Part of a square, and which plane is seen there.
  struct Piece {
    glm::vec2 at;
    float area;
    uint32_t plane;  // index into the planes of a Mix
  };
  // What a divided square sees within range.
  struct Mix {
    std::vector<const Sample*> planes;
    std::vector<Piece> pieces;
    bool told = true;  // the host could tell all of it
  };

  // Index of the plane of a sample.
  uint32_t planeOf(int32_t seen, Mix& mix) const {
    const Sample& sample = survey_.sample(seen);
    const auto known = std::ranges::find_if(mix.planes, [&](const Sample* plane) {
      return plane == &sample ||
             sspm::serves(plane->plane, sample.at, sample.plane, survey_.frame_.bias);
    });
    const auto index = static_cast<uint32_t>(known - mix.planes.begin());
    if (known == mix.planes.end()) mix.planes.push_back(&sample);
    return index;
  }

  void gather(int32_t index, Mix& mix) const {
    const Square& square = survey_.at(index);
    const float size = survey_.sizeOf(square);
    if (square.kind == Kind::kDivided) {
      for (int32_t i = 0; i < 4; ++i) gather(square.children + i, mix);
      return;
    }
    if (square.kind == Kind::kUntold) mix.told = false;
    if (std::ranges::none_of(square.corners, [&](int32_t corner) {
          return corner >= 0 && survey_.inRange(survey_.sample(corner));
        })) {
      return;
    }
    if (square.kind == Kind::kTwoPlanes) {
      std::array<std::optional<uint32_t>, 2> planes;
      const int side = glm::clamp(square.size / kPieceSize, 1, 4);
      for (int i = 0; i < side * side; ++i) {
        const glm::vec2 inSquare =
            (glm::vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
        const glm::vec2 place = unitsOf(square.corner) + inSquare * size;
        const bool second = glm::dot(square.line.normal, place) > square.line.offset;
        std::optional<uint32_t>& plane = planes[second ? 1 : 0];
        if (!plane) plane = planeOf(second ? square.second : square.first, mix);
        mix.pieces.push_back({place, size * size / static_cast<float>(side * side), *plane});
      }
    } else if (square.first >= 0) {
      mix.pieces.push_back({survey_.centreOf(square), size * size, planeOf(square.first, mix)});
    }
  }

  // The line across the direction between the centres of two planes' pieces that leaves the least
  // area on a wrong side.
  // other: area of all other planes. wrong: gets the area, if it is less than it was.
  static bool findLine(const Mix& mix, size_t a, size_t b, float other, float& wrong,
                       MapLine& line) {
    std::array<glm::vec2, 2> sums = {glm::vec2(0), glm::vec2(0)};
    std::array<float, 2> areas = {0, 0};
    for (const Piece& piece : mix.pieces) {
      if (piece.plane != a && piece.plane != b) continue;
      sums[piece.plane == b ? 1 : 0] += piece.at * piece.area;
      areas[piece.plane == b ? 1 : 0] += piece.area;
    }
    const glm::vec2 way = sums[1] / areas[1] - sums[0] / areas[0];
    if (glm::length(way) < 1e-4f) return false;
    std::vector<std::pair<float, float>> steps;  // place along the way, change of the wrong area
    for (const Piece& piece : mix.pieces) {
      if (piece.plane != a && piece.plane != b) continue;
      steps.emplace_back(glm::dot(way, piece.at), piece.plane == a ? -piece.area : piece.area);
    }
    std::ranges::sort(steps);
    bool found = false;
    float now = other + areas[0];  // with all on the second side
    for (size_t i = 0; i + 1 < steps.size(); ++i) {
      now += steps[i].second;
      if (now >= wrong) continue;
      wrong = now;
      found = true;
      const float middle = (steps[i].first + steps[i + 1].first) / 2;
      const glm::vec2 at = way * (middle / glm::dot(way, way)), along(-way.y, way.x);
      line = lineThrough(at - along, at + along, at + way);
    }
    return found;
  }

  // Whether a divided square is a leaf of a coarse map: one plane, or two and a line, serve all but
  // a small area of it.
  bool isCoarse(int32_t index, uint32_t& reference) {
    const Square& square = survey_.at(index);
    if (square.size > std::max(kCoarseLargest, least_)) return false;
    Mix& mix = mix_;
    mix.planes.clear();
    mix.pieces.clear();
    mix.told = true;
    gather(index, mix);
    if (!mix.told) return false;
    reference = kOpen;
    if (mix.planes.empty()) return true;
    std::vector<float> areas(mix.planes.size());
    for (const Piece& piece : mix.pieces) areas[piece.plane] += piece.area;
    const auto largest = [&] {
      return static_cast<size_t>(std::ranges::max_element(areas) - areas.begin());
    };
    const size_t a = largest();
    const float areaOfA = std::exchange(areas[a], 0.0f);
    float sum = 0;
    for (const float area : areas) sum += area;
    const size_t b = largest();
    if (square.size > least_ && sum - areas[b] > most_) return false;
    float wrong = sum;
    MapLine line;
    const bool divided =
        wrong > most_ && findLine(mix, a, b, sum - areas[b], wrong, line) && areaOfA > 0;
    if (wrong > most_ && square.size > least_) return false;
    const auto referenceOf = [&](const Sample& seen) {
      return planeFor(seen.plane, [&](const glm::vec4& plane) {
        return sspm::serves(plane, seen.at, seen.plane, survey_.frame_.bias);
      });
    };
    reference = referenceOf(*mix.planes[a]);
    if (!divided) return true;
    const uint32_t second = referenceOf(*mix.planes[b]);
    if (second != reference) reference = lineFor(square, line, reference, second);
    return true;
  }

  // Reference to the line of a square with two planes, or to one of the last lines between the same
  // planes that divides the square alike.
  uint32_t lineFor(const Square& square, const MapLine& own, uint32_t far, uint32_t near) {
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
  const float most_;
  bool full_ = false;
  ShotMap map_;
  Mix mix_;                                        // of isCoarse(), which keeps its memory
  std::vector<Line> lines_;                        // the last lines, newest last
  std::vector<glm::vec4> recent_;                  // the last planes used, newest last
  std::unordered_map<uint64_t, uint32_t> planes_;  // references by the words of a block
};

ShotMap Survey::map() const {
  return write(0, 0);
}

ShotMap Survey::coarseMap() const {
  return write(kCoarseLeast, kCoarseArea);
}

ShotMap Survey::write(int32_t least, float most) const {
  for (;; least = std::max(2 * least, 2)) {
    Writer writer(*this, least, most);
    ShotMap map = writer.write();
    if (!writer.isFull()) return map;
  }
}

}  // namespace grisaille::sspm
