// SPDX-License-Identifier: MIT
// Which rays to cast.
#include "survey.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "survey_slopes.h"

namespace grisaille::sspm {
namespace {

// Width on the surface below which nothing is divided, but at least a 128th of the range and at
// most a 32nd.
constexpr float kFinestMetres = 0.008f;
constexpr float kSurfaceMetres = 0.032f;  // largest width of a square with a surface in range
constexpr int kMostProbes = 6;
// Times the farthest surface so far: a farther one scales the map anew while probing, and later.
constexpr float kFarther = 1.25f, kFartherLater = 2;
constexpr size_t kMostSamples = 8192;  // rays after which no square is divided further
constexpr int32_t kLeastFollowed = kFinestAUnit / 8;  // width of squares that follow() leaves
constexpr int32_t kAcross = static_cast<int32_t>(2 * kMapReach) * kFinestAUnit;
constexpr float kAtRim = 1.15f;  // times the range: hits up to here need squares as fine as inside

static_assert(kAcross <= 0xFFFF);
uint32_t packed(const glm::ivec2& place) {
  return static_cast<uint32_t>(place.x) | static_cast<uint32_t>(place.y) << 16;
}

// Most places are multiples of a power of two, so that low bits of products say nothing.
uint32_t hashOf(uint32_t place) {
  const uint32_t hash = (place ^ place >> 16) * 0x9E3779B1u ^ place * 0x7FEB352Du;
  return hash ^ hash >> 15;
}

}  // namespace

Survey::Survey(const Shot& shot, float range, Detail detail)
    : frame_(shot, range), detail_(detail) {
  const float finest = kFinestMetres / 2 * kFinestAUnit / range;
  finest_ = static_cast<int32_t>(
      std::bit_floor(static_cast<uint32_t>(glm::clamp(finest, 1.0f, kFinestAUnit / 64.0f))));
  probe(64 * range);
}

// Sets the map's scale, from the distance of the farthest surface in the cylinder, metres.
void Survey::scaleTo(float farthest) {
  farthest_ = farthest;
  frame_.setFarthest(farthest);
}

// Rays in rings around the axis, which find the distance of the farthest surface in the cylinder.
void Survey::probe(float farthest) {
  scaleTo(farthest);
  samples_.assign(1, {});
  rays_.assign(1, rayTo(frame_, glm::vec2(0)));
  for (const float radius : {0.65f, 0.3f, 0.95f}) {
    if (probes_ == 0 && radius != 0.65f) break;  // the first round only finds the scale
    for (int i = 0; i < 8; ++i) {
      const float angle = (static_cast<float>(i) + radius) * 0.785398f;
      samples_.emplace_back();
      rays_.push_back(rayTo(frame_, radius * glm::vec2(std::cos(angle), std::sin(angle))));
    }
  }
  asked_.resize(samples_.size());
  for (size_t i = 0; i < asked_.size(); ++i) asked_[i] = static_cast<int32_t>(i);
}

bool Survey::probed() {
  float found = 0;
  bool unknown = false;
  for (const Sample& sample : samples_) {
    unknown = unknown || sample.unknown;
    if (inRange(sample)) found = std::max(found, glm::dot(sample.at, frame_.direction));
  }
  if (found <= 0 && unknown) return false;
  const bool first = probes_ == 0;
  if (++probes_ < kMostProbes && found > 0 && (first || found >= kFarther * farthest_)) {
    probe(found);
    return true;
  }
  stage_ = Stage::kRough;
  begin();
  return true;
}

// Starts without samples.
void Survey::begin() {
  samples_.clear();
  slots_.assign(2048, {});
  start();
}

// Starts with one square; keeps the samples.
void Survey::start() {
  squares_.assign(1, {.size = kAcross});
  silhouettes_.clear();
  ragged_.clear();
  undecided_.assign(1, 0);
  advance();
  writeRays();
}

void Survey::refine() {
  stage_ = Stage::kFine;
  start();
}

// Decides what squares see, as far as that is possible without more rays.
void Survey::advance() {
  std::vector<int32_t> waiting;
  while (true) {
    while (!undecided_.empty()) {
      for (const int32_t index : std::exchange(undecided_, {})) {
        if (!decide(index)) waiting.push_back(index);
      }
    }
    if (!waiting.empty() || stage_ != Stage::kFine) break;
    doubt();
    if (undecided_.empty()) follow();
    if (undecided_.empty()) break;
  }
  undecided_ = std::move(waiting);
  if (undecided_.empty()) unite();
}

// Opens the squares of one plane beside depth discontinuities again: an object smaller than a
// square may be in front of them. decide() then asks for their centres too.
void Survey::doubt() {
  std::ranges::sort(ragged_);
  for (const int32_t ragged : std::exchange(ragged_, {})) {
    const Square& square = at(ragged);
    for (const int32_t index : neighboursOf(square)) {
      if (index < 0) continue;
      Square& other = at(index);
      if (other.kind != Kind::kOnePlane || other.doubtful || other.size < 8 * finest_) continue;
      other.doubtful = true;
      other.kind = Kind::kUndecided;
      undecided_.push_back(index);
    }
  }
}

// Divides squares whose corners see nothing while a ray through one of their sides saw a surface in
// range, which therefore goes on inside: a branch or a cable.
void Survey::follow() {
  const auto count = static_cast<int32_t>(squares_.size());
  for (int32_t index = 0; index < count; ++index) {
    const Square& square = at(index);
    if (square.kind != Kind::kNothing || square.size <= kLeastFollowed) continue;
    if (seesAtSides(square)) divide(index);
  }
}

bool Survey::seesAtSides(const Square& square) const {
  const int32_t step = std::max(kLeastFollowed, square.size / 8);
  const auto sees = [&](int32_t x, int32_t y) {
    const int32_t seen = known(square.corner + glm::ivec2(x, y));
    return seen >= 0 && inRange(sample(seen));
  };
  for (int32_t i = step; i < square.size; i += step) {
    if (sees(i, 0) || sees(i, square.size) || sees(0, i) || sees(square.size, i)) return true;
  }
  return false;
}

// The leaves beyond the middles of a square's four sides; -1 outside the map.
std::array<int32_t, 4> Survey::neighboursOf(const Square& square) const {
  constexpr std::array<glm::ivec2, 4> kSides = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::array<int32_t, 4> leaves;
  std::ranges::transform(kSides, leaves.begin(), [&](const glm::ivec2& side) {
    return leafAt(square.corner + square.size / 2 + side * (square.size / 2 + 1));
  });
  return leaves;
}

int32_t Survey::leafAt(const glm::ivec2& place) const {
  if (glm::any(glm::lessThan(place, glm::ivec2(0))) ||
      glm::any(glm::greaterThanEqual(place, glm::ivec2(kAcross)))) {
    return -1;
  }
  int32_t index = 0;
  while (at(index).children >= 0) {
    const glm::ivec2 inside = place - at(index).corner;
    const int32_t half = at(index).size / 2;
    index = at(index).children + (inside.x >= half ? 1 : 0) + (inside.y >= half ? 2 : 0);
  }
  return index;
}

// Index of the sample at a place. Asks for its ray if there is none.
int32_t Survey::ask(const glm::ivec2& place) {
  if (samples_.size() * 2 >= slots_.size()) growSlots();
  Slot& slot = slots_[slotOf(place)];
  if (slot.sample < 0) {
    slot = {packed(place), static_cast<int32_t>(samples_.size())};
    asked_.push_back(slot.sample);
    samples_.push_back({.place = place});
  }
  return slot.sample;
}

// Index of the sample at a place; -1: none.
int32_t Survey::known(const glm::ivec2& place) const {
  return slots_[slotOf(place)].sample;
}

// Index of the slot of a place, or of the free one where it belongs.
size_t Survey::slotOf(const glm::ivec2& place) const {
  const size_t mask = slots_.size() - 1;
  const uint32_t wanted = packed(place);
  size_t at = hashOf(wanted) & mask;
  while (slots_[at].sample >= 0 && slots_[at].place != wanted) at = (at + 1) & mask;
  return at;
}

void Survey::growSlots() {
  slots_.assign(2 * slots_.size(), {});
  for (size_t i = 0; i < samples_.size(); ++i) {
    slots_[slotOf(samples_[i].place)] = {packed(samples_[i].place), static_cast<int32_t>(i)};
  }
}

void Survey::writeRays() {
  rays_.resize(asked_.size());
  for (size_t i = 0; i < asked_.size(); ++i) {
    rays_[i] = rayTo(frame_, unitsOf(sample(asked_[i]).place));
  }
}

size_t Survey::bytes() const {
  return samples_.capacity() * sizeof(Sample) + slots_.capacity() * sizeof(Slot) +
         squares_.capacity() * sizeof(Square) + silhouettes_.capacity() * sizeof(Silhouette) +
         rays_.capacity() * sizeof(grisaille_ray);
}

size_t Survey::countUnknown(float within) const {
  return static_cast<size_t>(std::ranges::count_if(samples_, [&](const Sample& sample) {
    return sample.unknown && glm::length(unitsOf(sample.place)) < within;
  }));
}

void Survey::askAgain() {
  if (!rays_.empty()) return;
  asked_.clear();
  for (size_t i = 0; i < samples_.size(); ++i) {
    if (samples_[i].unknown) asked_.push_back(static_cast<int32_t>(i));
  }
  for (size_t i = 0; i < squares_.size(); ++i) {
    if (squares_[i].kind == Kind::kUntold) undecided_.push_back(static_cast<int32_t>(i));
  }
  writeRays();
}

bool Survey::take(std::span<const grisaille_hit> hits) {
  float found = 0;
  for (size_t i = 0; i < asked_.size(); ++i) {
    Sample& sample = samples_[static_cast<size_t>(asked_[i])];
    sample.told = true;
    sample.unknown = hits[i].kind == GRISAILLE_HIT_UNKNOWN;
    sample.hit = hits[i].kind == GRISAILLE_HIT_SURFACE;
    if (!sample.hit) continue;
    const auto& way = rays_[i].direction;
    sample.at = hits[i].distance * glm::vec3(way[0], way[1], way[2]);
    sample.across = frame_.across(sample.at);
    sample.plane = planeOf({hits[i].normal[0], hits[i].normal[1], hits[i].normal[2]}, sample.at);
    if (inRange(sample)) found = std::max(found, glm::dot(sample.at, frame_.direction));
  }
  rays_.clear();
  asked_.clear();
  if (stage_ == Stage::kProbing) return probed();
  // Surfaces seen through a gap that no probe met would have too wide squares.
  if (found >= kFartherLater * farthest_ && probes_ < kMostProbes) {
    ++probes_;
    scaleTo(found);
    begin();
    return true;
  }
  advance();
  writeRays();
  return true;
}

// The plane through a hit, rounded: to the normals that a map holds, and to a 16th of the bias. All
// hits of a facet have the same plane then. A plane close to the muzzle keeps its distance, which
// decides what it hides.
glm::vec4 Survey::planeOf(const glm::vec3& normal, const glm::vec3& at) const {
  const glm::vec3 rounded = roundedNormal(normal);
  const float distance = glm::dot(rounded, at);
  const float step = std::abs(distance) > frame_.bias ? frame_.bias / 16 : 0;
  return glm::vec4(rounded, step > 0 ? std::round(distance / step) * step : distance);
}

bool Survey::inRange(const Sample& sample) const {
  return sample.hit && sample.across < frame_.range * kBeyond;
}

float Survey::sizeOf(const Square& square) const {
  return static_cast<float>(square.size) / kFinestAUnit;
}

glm::vec2 Survey::centreOf(const Square& square) const {
  return unitsOf(square.corner) + sizeOf(square) / 2;
}

// Largest width of an undivided square, as far as its corners are known. The rough picture has
// coarse squares. The map has fine ones where rays hit something in range, unless that is calm.
int32_t Survey::grainAt(const Square& square) const {
  constexpr int32_t kUnit = kFinestAUnit;
  // Twice the distance of the square from the map's centre, in finest squares.
  const glm::ivec2 nearest =
      glm::max(glm::abs(2 * square.corner + square.size - kAcross) - square.size, 0);
  const int64_t distance2 = int64_t{nearest.x} * nearest.x + int64_t{nearest.y} * nearest.y;
  const auto isWithin = [&](int64_t units) {
    return distance2 < 4 * units * units * kUnit * kUnit;
  };
  if (stage_ == Stage::kRough) return isWithin(1) ? kUnit / 4 : isWithin(3) ? kUnit : 4 * kUnit;
  bool hits = false, within = false;
  for (const int32_t corner : square.corners) {
    if (corner < 0 || !sample(corner).hit) continue;
    hits = true;
    within = within || sample(corner).across < kAtRim * frame_.range;
  }
  if (!isWithin(3)) return within ? kUnit : 4 * kUnit;
  const bool large = kUnit / 8 * frame_.range > kSurfaceMetres * kUnit;
  const int32_t fine = large ? kUnit / 16 : kUnit / 8;
  if (within) return square.size == 2 * fine && isCalm(square) ? 2 * fine : fine;
  return hits || isWithin(1) ? kUnit / 4 : kUnit;
}

// Whether one plane is seen at a square's corners, and at those of its eight neighbours that rays
// have met so far.
bool Survey::isCalm(const Square& square) const {
  const Sample& first = sample(square.corners[0]);
  if (!first.told || !first.hit) return false;
  for (int32_t i = 0; i < 16; ++i) {
    const int32_t seen = known(square.corner + square.size * (glm::ivec2(i % 4, i / 4) - 1));
    if (seen < 0 || !sample(seen).told) continue;
    if (!sample(seen).hit || sample(seen).plane != first.plane) return false;
  }
  return true;
}

// Width at which a square is not divided further, whatever it sees.
int32_t Survey::finestAt(const Square& square) const {
  if (samples_.size() >= kMostSamples) return kAcross;
  if (isCoarse()) return kCoarseLeast;
  return glm::length(centreOf(square)) > 4 ? kFinestAUnit / 16 : 2 * finest_;
}

void Survey::divide(int32_t index) {
  const glm::ivec2 corner = at(index).corner;
  const int32_t half = at(index).size / 2;
  const auto first = static_cast<int32_t>(squares_.size());
  at(index).kind = Kind::kDivided;
  at(index).children = first;
  for (int32_t i = 0; i < 4; ++i) {
    squares_.push_back({.corner = corner + half * glm::ivec2(i & 1, i >> 1), .size = half});
    undecided_.push_back(first + i);
  }
}

}  // namespace grisaille::sspm
