// SPDX-License-Identifier: MIT
// The patches of surfaces that a survey found.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "survey.h"
#include "survey_slopes.h"

namespace grisaille::sspm {
namespace {

constexpr int32_t kPatchSize = kFinestAUnit / 4;  // width of the largest patch
constexpr size_t kSeenPoints = 8;                 // that most planes of a patch have
constexpr int32_t kMixedSize = kFinestAUnit / 8;  // of a square with several planes

}  // namespace

std::vector<Patch> Survey::patches() const {
  std::vector<Patch> result;
  if (stage_ != Stage::kProbing) gatherPatches(0, result);
  return result;
}

void Survey::gatherPatches(int32_t index, std::vector<Patch>& patches) const {
  const Square& square = at(index);
  if (square.kind == Kind::kNothing || square.kind == Kind::kUntold) return;
  if (square.size <= kPatchSize && square.uniform != kMixed) {
    if (square.uniform == kEmpty) return;
    const Patch patch = patchOf(square, sample(square.uniform).plane);
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
    if (known == planes.end()) {
      known = planes.insert(planes.end(), {&seen, {}});
      known->seen.reserve(kSeenPoints);
    }
    known->seen.push_back(point);
  };
  if (square.kind == Kind::kDivided) {
    for (int32_t i = 0; i < 4; ++i) gatherPlanes(square.children + i, planes, ragged);
  } else if (square.kind == Kind::kTwoPlanes) {
    // Each plane at those of nine places that are on its side; of four in a small square.
    const int side = square.size < kMixedSize ? 2 : 3;
    for (int i = 0; i < side * side; ++i) {
      const glm::vec2 step = glm::vec2(i % side, i / side) / static_cast<float>(side - 1);
      const glm::vec2 place = unitsOf(square.corner) + step * sizeOf(square);
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
  if (square.uniform >= 0 && sample(square.uniform).plane == plane) return true;
  switch (square.kind) {
    case Kind::kNothing:
      return true;
    case Kind::kOnePlane:
      return !square.open && std::ranges::all_of(square.corners, [&](int32_t corner) {
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

// Finds the squares whose leaves one plane serves. Children come after their parents.
void Survey::unite() {
  for (size_t i = squares_.size(); i-- > 0;) {
    squares_[i].uniform = kMixed;
    squares_[i].uniform = unitedBy(static_cast<int32_t>(i));
  }
}

// See Square::uniform. Children have theirs.
int32_t Survey::unitedBy(int32_t index) const {
  const Square& square = at(index);
  if (square.kind == Kind::kNothing) return kEmpty;
  if (square.kind == Kind::kOnePlane) {
    return serves(index, sample(square.first).plane) ? square.first : kMixed;
  }
  if (square.kind != Kind::kDivided) return kMixed;
  int32_t first = kEmpty;
  for (int32_t i = 0; i < 4; ++i) {
    const int32_t child = at(square.children + i).uniform;
    if (child == kMixed) return kMixed;
    if (first == kEmpty) first = child;
  }
  return first == kEmpty || serves(index, sample(first).plane) ? first : kMixed;
}

}  // namespace grisaille::sspm
