// SPDX-License-Identifier: MIT
#include "muzzle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grisaille::sspm {
namespace {

constexpr int32_t kWidest = 16;        // pixels on which a slant is measured
constexpr float kFlat = 1e-4f;         // of a nearness: how far off a plane's pixels may be
constexpr float kFlatOfSlant = 0.05f;  // the same, of the change from pixel to pixel
constexpr float kMostSlant = 0.5f;     // of a nearness, from pixel to pixel

}  // namespace

std::optional<Muzzle> Muzzle::look(const ShotFrame& frame, const DrawDepth& draw) {
  Muzzle muzzle(frame);
  for (size_t i = 0; i < kSlopes.size(); ++i) {
    const grisaille_depth_view view = {
        .origin = {frame.origin.x, frame.origin.y, frame.origin.z},
        .direction = {frame.direction.x, frame.direction.y, frame.direction.z},
        .up = {frame.up.x, frame.up.y, frame.up.z},
        .slope = kSlopes[i],
        .size = kSize};
    Nearness& picture = muzzle.pictures_[i];
    picture.resize(size_t{kSize} * kSize);
    if (!draw(view, picture)) return std::nullopt;
    for (float& value : picture) value = 1 / value;
  }
  return muzzle;
}

bool Muzzle::isKnown() const {
  return std::ranges::all_of(pictures_, [](const Nearness& picture) {
    return std::ranges::any_of(picture, [](float value) { return !std::isnan(value); });
  });
}

// Change of the nearness from pixel to pixel, along a row or a column, on the side of `at` where
// the pixels lie on one plane best; 0 if they do on neither. It is measured on as many pixels as
// lie on that plane, since a depth buffer rounds. step: from a pixel to the next. before, after:
// number of pixels on both sides.
float Muzzle::slant(const Nearness& picture, int32_t at, int32_t step, int32_t before,
                    int32_t after) {
  const auto value = [&](int32_t pixels) {
    const int32_t index = at + pixels * step;
    return picture[static_cast<size_t>(index)];
  };
  float best = 0, least = std::numeric_limits<float>::infinity();
  int32_t side = 0;
  for (const auto& [sign, room] : {std::pair{1, after}, std::pair{-1, before}}) {
    if (room < 2) continue;
    const float change = value(sign) - value(0);
    const float bend = std::abs(value(2 * sign) - value(sign) - change);
    if (!(bend < least)) continue;
    least = bend;
    best = change * static_cast<float>(sign);
    side = sign;
  }
  const float allowed = kFlat * value(0) + kFlatOfSlant * std::abs(best);
  if (!(least <= allowed) || std::abs(best) > kMostSlant * value(0)) {
    if (before < 1 || after < 1) return 0;
    const float next = value(1) - value(0), last = value(0) - value(-1);
    const float smaller = std::abs(next) < std::abs(last) ? next : last;
    return std::abs(smaller) < 0.1f * value(0) ? smaller : 0;
  }
  const int32_t room = std::min(side > 0 ? after : before, kWidest);
  for (int32_t n = 2; n <= room; ++n) {
    const auto reach = static_cast<float>(n);
    const float mean = (value(n * side) - value(0)) / reach * static_cast<float>(side);
    if (!(std::abs(mean - best) * reach <= allowed)) break;
    best = mean;
  }
  return best;
}

grisaille_hit Muzzle::see(const grisaille_ray& ray) const {
  const glm::vec3 way(ray.direction[0], ray.direction[1], ray.direction[2]);
  const float along = glm::dot(way, direction_);
  if (along <= 0) return {};
  // By rows from the top: y is downwards.
  const glm::vec2 slope(glm::dot(way, right_) / along, -glm::dot(way, up_) / along);
  const float steepest = std::max(std::abs(slope.x), std::abs(slope.y));
  size_t level = kSlopes.size();
  while (level > 0 && steepest > kSlopes[level - 1] * (1 - 2.0f / kSize)) --level;
  if (level == 0) return {};
  const float pixel = 2 * kSlopes[level - 1] / kSize;
  const glm::vec2 place = slope / pixel + kSize / 2.0f;
  const glm::ivec2 at(place);
  const auto index = static_cast<int32_t>(at.y * kSize + at.x);
  const Nearness& picture = pictures_[level - 1];
  const float near = picture[static_cast<size_t>(index)];
  if (std::isnan(near)) return {.kind = GRISAILLE_HIT_UNKNOWN, .distance = 0, .normal = {}};
  if (near <= 0) return {};
  constexpr int32_t kLast = kSize - 1;
  const glm::vec2 slants(slant(picture, index, 1, at.x, kLast - at.x),
                         slant(picture, index, kSize, at.y, kLast - at.y));
  const float here = near + glm::dot(slants, place - (glm::vec2(at) + 0.5f));
  const float depth = 1 / (here > 0 ? here : near);
  if (depth > ray.reach * along) return {};
  // The plane has dot(p, offset) = 1.
  const glm::vec2 p = slants / pixel;
  const glm::vec3 plane = p.x * right_ - p.y * up_ + (here - glm::dot(p, slope)) * direction_;
  const glm::vec3 normal = -glm::normalize(plane);
  return {.kind = GRISAILLE_HIT_SURFACE,
          .distance = depth / along,
          .normal = {normal.x, normal.y, normal.z}};
}

}  // namespace grisaille::sspm
