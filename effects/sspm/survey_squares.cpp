// SPDX-License-Identifier: MIT
// What a square of the map sees, by the rays through its corners.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "survey.h"
#include "survey_slopes.h"

namespace grisaille::sspm {
namespace {

constexpr float kSafety = 0.75f;  // share of the map's bias that planes may be off at corners
// Of a finest square's width on the surface: by how much its far corners lie behind its near ones.
constexpr float kGap = 2;
// Of finest squares: width of squares across a surface's edge.
constexpr int32_t kEdge = 2;
// Corners of a square around it, of those by rows.
constexpr std::array<size_t, 4> kAround = {0, 1, 3, 2};

}  // namespace

// Decides what a square sees, or divides it. Returns false if it asked for rays.
bool Survey::decide(int32_t index) {
  Square& square = at(index);  // valid until divide()
  if (square.corners[0] < 0 && square.size <= grainAt(square)) {
    for (int32_t i = 0; i < 4; ++i) {
      square.corners[static_cast<size_t>(i)] =
          ask(square.corner + square.size * glm::ivec2(i & 1, i >> 1));
    }
  }
  bool told = true, unknown = false, hit = false, within = false;
  if (square.corners[0] >= 0) {
    for (const int32_t corner : square.corners) {
      const Sample& seen = sample(corner);
      told = told && seen.told;
      unknown = unknown || seen.unknown;
      hit = hit || seen.hit;
      within = within || inRange(seen);
    }
    if (!told) return false;
  }
  if (square.size > grainAt(square)) {
    divide(index);
    return true;
  }
  const bool wasRagged = square.ragged;
  Found found = Found::kYes;
  if (square.step != Square::Step::kPlane) {
    found = findLine(square);
  } else if (unknown || !hit) {
    square.kind = unknown ? Kind::kUntold : Kind::kNothing;
  } else {
    const Misfits misfits = misfitsOf(square);
    found = findPlane(square, misfits, within);
    const bool divides = found == Found::kNo && stage_ == Stage::kFine && !square.blocked;
    if (divides && findPair(square, misfits)) found = findLine(square);
  }
  if (found == Found::kNo) {
    if (stage_ == Stage::kFine && square.size > finestAt(square)) {
      square.ragged = wasRagged;
      divide(index);
      return true;
    }
    settle(square);
  }
  if (square.ragged && !wasRagged) ragged_.push_back(index);
  if (found != Found::kWait) return true;
  square.kind = Kind::kUndecided;
  return false;
}

// How far the hit of a sample is from the plane of another, in shares of what a leaf may have. Both
// have hits.
float Survey::misfit(int32_t plane, int32_t other) const {
  const Sample& seen = sample(other);
  if (sample(plane).plane == seen.plane) return 0;
  return std::abs(depthBehind(frame_, sample(plane).plane, seen.at, glm::vec3(seen.plane))) /
         kSafety;
}

Survey::Misfits Survey::misfitsOf(const Square& square) const {
  Misfits misfits = {};
  const glm::vec4& plane = sample(square.corners[0]).plane;
  const bool onePlane = std::ranges::all_of(square.corners, [&](int32_t corner) {
    return sample(corner).hit && sample(corner).plane == plane;
  });
  if (onePlane) return misfits;
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j) {
      const int32_t a = square.corners[i], b = square.corners[j];
      if (i != j && sample(a).hit && sample(b).hit) misfits[i][j] = misfit(a, b);
    }
  }
  return misfits;
}

// Finds one plane for the whole square: that of the corner which serves all others best. Bent
// surfaces lie partly behind the plane; it is moved back to the farthest corner. A corner without a
// hit agrees with every plane. The square then lies across an edge of the surface, where the muzzle
// often grazes further facets, far behind the plane: small squares there hide nothing.
// within: the square has surfaces in range. Otherwise any plane does.
Survey::Found Survey::findPlane(Square& square, const Misfits& misfits, bool within) {
  float least = within ? 1 : std::numeric_limits<float>::infinity();
  square.first = -1;
  for (size_t i = 0; i < 4; ++i) {
    const int32_t plane = square.corners[i];
    if (!sample(plane).hit) continue;
    const float worst = std::ranges::max(misfits[i]);
    if (worst > least) continue;
    float behind = 0;
    for (const int32_t other : square.corners) {
      if (!sample(other).hit) continue;
      const glm::vec4& it = sample(plane).plane;
      behind = std::max(behind, it.w - glm::dot(glm::vec3(it), sample(other).at));
    }
    least = worst;
    square.first = plane;
    square.shift = within ? behind : 0;
  }
  if (square.first < 0) return Found::kNo;
  square.open = within && !isCoarse() && isAcrossEdge(square);
  square.blocked = square.open && stage_ == Stage::kFine && square.size > kEdge * finestAt(square);
  if (square.blocked) return Found::kNo;
  square.kind = Kind::kOnePlane;
  if (!square.doubtful) return Found::kYes;
  const int32_t centre = ask(square.corner + square.size / 2);
  if (!sample(centre).told) return Found::kWait;
  square.blocked = sample(centre).hit && misfit(square.first, centre) > 1;
  return square.blocked ? Found::kNo : Found::kYes;
}

// Whether some corners see nothing.
bool Survey::isAcrossEdge(const Square& square) const {
  return std::ranges::any_of(square.corners, [&](int32_t corner) { return !sample(corner).hit; });
}

// Two planes that together serve all corners. Sets the square's first, which lies behind, and its
// second.
bool Survey::findPair(Square& square, const Misfits& misfits) const {
  float least = 1;
  bool found = false;
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = i + 1; j < 4; ++j) {
      const int32_t a = square.corners[i], b = square.corners[j];
      if (!sample(a).hit || !sample(b).hit) continue;
      float worst = 0;
      for (size_t k = 0; k < 4; ++k)
        worst = std::max(worst, std::min(misfits[i][k], misfits[j][k]));
      if (worst > least) continue;
      least = worst;
      found = true;
      const bool behind =
          glm::dot(sample(a).at, frame_.direction) > glm::dot(sample(b).at, frame_.direction);
      square.first = behind ? a : b;
      square.second = behind ? b : a;
    }
  }
  return found;
}

// Which plane of a pair a ray saw. Where there is no surface, nothing hides the far one.
Survey::Side Survey::sideOf(const Pair& pair, int32_t index) const {
  if (sample(index).unknown) return Side::kNeither;
  if (!sample(index).hit) return Side::kFar;
  const float far = misfit(pair.far, index), near = misfit(pair.near, index);
  if (std::min(far, near) > 1) return Side::kNeither;
  return far <= near ? Side::kFar : Side::kNear;
}

// Divides the square between two planes by a line. If it waits for rays, it goes on from the
// square's step.
Survey::Found Survey::findLine(Square& square) {
  using Step = Square::Step;
  const Pair pair = {.far = square.first, .near = square.second};
  if (square.step == Step::kPlane) {
    const bool isCrease = findCrease(square, pair, square.line);
    // As in findPlane().
    if (isCrease && !isCoarse() && isAcrossEdge(square) && square.size > kEdge * finestAt(square)) {
      return Found::kNo;
    }
    square.step = isCrease ? Step::kCrease : Step::kSilhouette;
  }
  square.kind = Kind::kTwoPlanes;
  square.shift = 0;
  square.ragged = false;
  if (square.step == Step::kCrease) {
    const Found found = confirm(square, pair, square.line);
    if (found != Found::kNo) return found;
    square.step = Step::kSilhouette;
  }
  square.ragged = true;
  const Found found = findSilhouette(square, pair);
  return found == Found::kYes ? confirm(square, pair, square.line) : found;
}

// Whether the ray through the square's centre sees what a line predicts.
Survey::Found Survey::confirm(const Square& square, const Pair& pair, const MapLine& line) {
  if (square.size <= 4 * finest_) return Found::kYes;
  const int32_t centre = ask(square.corner + square.size / 2);
  if (!sample(centre).told) return Found::kWait;
  if (sample(centre).unknown) return Found::kNo;
  if (!sample(centre).hit) return Found::kYes;
  const float off = glm::dot(line.normal, centreOf(square)) - line.offset;
  const bool close = std::abs(off) <= sizeOf(square) / 16;
  const float far = misfit(pair.far, centre), near = misfit(pair.near, centre);
  return (close ? std::min(far, near) : off > 0 ? near : far) <= 1 ? Found::kYes : Found::kNo;
}

// The line where two planes meet, if that is what the corners see: a ridge, where the farther plane
// is the visible one, or a valley, where the nearer is. It takes no rays.
bool Survey::findCrease(const Square& square, const Pair& pair, MapLine& line) const {
  const glm::vec4 &far = sample(pair.far).plane, &near = sample(pair.near).plane;
  const float reach = sizeOf(square) * frame_.range;
  if (std::abs(glm::dot(glm::vec3(far), sample(pair.near).at) - far.w) > reach ||
      std::abs(glm::dot(glm::vec3(near), sample(pair.far).at) - near.w) > reach) {
    return false;
  }
  std::array<glm::vec2, 4> places;
  std::array<float, 4> before;  // by how much the near plane is nearer
  bool ridge = true, valley = true;
  glm::vec2 second(0);
  float most = 0;
  for (size_t i = 0; i < 4; ++i) {
    const Sample& corner = sample(square.corners[i]);
    places[i] = unitsOf(corner.place);
    before[i] = nearness(frame_, near, places[i]) - nearness(frame_, far, places[i]);
    if (!corner.hit) continue;
    const bool isNear = sideOf(pair, square.corners[i]) == Side::kNear;
    ridge = ridge && isNear == (before[i] < 0);
    valley = valley && isNear == (before[i] > 0);
    if (!isNear || std::abs(before[i]) <= most) continue;
    most = std::abs(before[i]);
    second = places[i];
  }
  if (!ridge && !valley) return false;
  std::array<glm::vec2, 4> crossings;
  size_t count = 0;
  for (size_t i = 0; i < 4; ++i) {
    const size_t a = kAround[i], b = kAround[(i + 1) % 4];
    if ((before[a] > 0) == (before[b] > 0)) continue;
    crossings[count++] = glm::mix(places[a], places[b], before[a] / (before[a] - before[b]));
  }
  if (count != 2 || glm::distance(crossings[0], crossings[1]) < 1e-4f) return false;
  line = lineThrough(crossings[0], crossings[1], second);
  return true;
}

// Starts the search for the line along which the near surface ends before the far one. Returns
// false if it does not cross two sides.
bool Survey::startSilhouette(Square& square, const Pair& pair) {
  std::array<Side, 4> sides;
  std::array<glm::vec2, 2> sum = {glm::vec2(0), glm::vec2(0)};  // of the far and near corners
  std::array<float, 2> corners = {0, 0};
  for (size_t i = 0; i < 4; ++i) {
    sides[i] = sideOf(pair, square.corners[i]);
    if (sides[i] == Side::kNeither) return false;
    const size_t side = sides[i] == Side::kNear ? 1 : 0;
    sum[side] += unitsOf(sample(square.corners[i]).place);
    corners[side] += 1;
  }
  Silhouette found;
  size_t count = 0;
  for (size_t i = 0; i < 4; ++i) {
    const size_t a = kAround[i], b = kAround[(i + 1) % 4];
    if (sides[a] == sides[b]) continue;
    if (count == 2) return false;
    const glm::ivec2 from = sample(square.corners[a]).place;
    const bool rough = isCoarse() || glm::length(unitsOf(from)) > 4;
    found.crossings[count++] = {.from = from,
                                .to = sample(square.corners[b]).place,
                                .start = sides[a],
                                .last = rough ? std::max(finest_, kFinestAUnit / 64) : finest_};
  }
  if (count != 2) return false;
  found.towards = sum[1] / corners[1] - sum[0] / corners[0];
  square.silhouette = static_cast<int32_t>(silhouettes_.size());
  silhouettes_.push_back(found);
  return true;
}

Survey::Found Survey::findSilhouette(Square& square, const Pair& pair) {
  if (square.silhouette < 0 && !startSilhouette(square, pair)) return Found::kNo;
  Silhouette& silhouette = silhouettes_[static_cast<size_t>(square.silhouette)];
  std::array<glm::vec2, 2> crossings;
  bool wait = false;
  for (size_t i = 0; i < 2; ++i) {
    Bisection& side = silhouette.crossings[i];
    const Found found = narrow(pair, side);
    if (found == Found::kNo) return found;
    wait = wait || found == Found::kWait;
    crossings[i] = (unitsOf(side.from) + unitsOf(side.to)) / 2.0f;
  }
  if (wait) return Found::kWait;
  if (glm::distance(crossings[0], crossings[1]) < 1e-4f) return Found::kNo;
  const glm::vec2 middle = (crossings[0] + crossings[1]) / 2.0f;
  square.line = lineThrough(crossings[0], crossings[1], middle + silhouette.towards);
  return Found::kYes;
}

// Bisects a side of a square as far as rays are known.
Survey::Found Survey::narrow(const Pair& pair, Bisection& side) {
  while (std::abs(side.to.x - side.from.x) + std::abs(side.to.y - side.from.y) > side.last) {
    const glm::ivec2 middle = (side.from + side.to) / 2;
    if (side.middle < 0) side.middle = ask(middle);
    if (!sample(side.middle).told) return Found::kWait;
    const Side seen = sideOf(pair, std::exchange(side.middle, -1));
    if (seen == Side::kNeither) return Found::kNo;
    (seen == side.start ? side.from : side.to) = middle;
  }
  return Found::kYes;
}

// For a square that cannot be divided further: a line half-way between its near corners and its far
// ones, or one plane for all.
void Survey::settle(Square& square) {
  square.ragged = true;
  square.shift = 0;
  const Corners near = nearCorners(square);
  Corners far;
  std::ranges::transform(near, far.begin(), std::logical_not());
  if (lineBetween(square, near, square.line)) {
    square.kind = Kind::kTwoPlanes;
    square.first = farthestPlane(square, far);
    square.second = farthestPlane(square, near);
  } else {
    square.kind = Kind::kSeveral;
    square.first = farthestPlane(square, {true, true, true, true});
  }
}

// The corners before the widest gap between the distances of the corners' hits. None, if no gap is
// much wider than the square.
Survey::Corners Survey::nearCorners(const Square& square) const {
  std::array<std::pair<float, size_t>, 4> hits;  // distance along the shot's direction, corner
  size_t count = 0;
  for (size_t i = 0; i < 4; ++i) {
    const Sample& corner = sample(square.corners[i]);
    constexpr float kFarthest = std::numeric_limits<float>::max();
    hits[i] = {corner.hit ? glm::dot(corner.at, frame_.direction) : kFarthest, i};
    count += corner.hit ? 1 : 0;
  }
  std::ranges::sort(hits);
  float widest = kGap * sizeOf(square) * frame_.range;
  size_t nearCount = 0;
  for (size_t i = 1; i < count; ++i) {
    const float gap = hits[i].first - hits[i - 1].first;
    if (gap <= widest) continue;
    widest = gap;
    nearCount = i;
  }
  Corners near = {};
  for (size_t i = 0; i < nearCount; ++i) near[hits[i].second] = true;
  return near;
}

// The line through the middles of the two sides that lead from `near` corners to others. Returns
// false if none or four do.
bool Survey::lineBetween(const Square& square, const Corners& near, MapLine& line) const {
  std::array<glm::vec2, 4> middles;
  size_t count = 0;
  glm::vec2 within(0);
  for (size_t i = 0; i < 4; ++i) {
    const size_t a = kAround[i], b = kAround[(i + 1) % 4];
    const glm::vec2 place = unitsOf(sample(square.corners[a]).place);
    if (near[a]) within += place / static_cast<float>(std::ranges::count(near, true));
    if (near[a] == near[b]) continue;
    middles[count++] = (place + unitsOf(sample(square.corners[b]).place)) / 2.0f;
  }
  if (count == 2) line = lineThrough(middles[0], middles[1], within);
  return count == 2;
}

// The sample, of those at `some` corners, behind whose plane the fewest others lie. -1: no hits.
int32_t Survey::farthestPlane(const Square& square, const Corners& some) const {
  int32_t best = -1;
  std::ptrdiff_t most = 0;
  for (size_t i = 0; i < 4; ++i) {
    const int32_t plane = square.corners[i];
    if (!some[i] || !sample(plane).hit) continue;
    std::ptrdiff_t served = 0;
    for (size_t j = 0; j < 4; ++j) {
      const Sample& seen = sample(square.corners[j]);
      if (!some[j] || !seen.hit) continue;
      const float behind = depthBehind(frame_, sample(plane).plane, seen.at, glm::vec3(seen.plane));
      served += behind <= 1 ? 1 : 0;
    }
    if (served <= most) continue;
    most = served;
    best = plane;
  }
  return best;
}

}  // namespace grisaille::sspm
