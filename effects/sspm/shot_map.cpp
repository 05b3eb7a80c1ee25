// SPDX-License-Identifier: MIT
#include "shot_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace grisaille::sspm {
namespace {

// Same as in shaders/sspm/walk.glsl. kOther and kSame are cosines between facets' normals: at kSame
// and above it is the same surface, with the full bias; at kOther and below another, with
// kLeastBias of it.
constexpr float kSlant = 8;  // largest depth behind the plane along the ray, in biases
constexpr float kOther = -0.5f, kSame = 0.3f, kLeastBias = 0.05f;
constexpr float kBiasUnits = 0.02f;  // of the range
constexpr float kBiasShare = 2e-5f;  // of the distance

}  // namespace

ShotFrame::ShotFrame(const Shot& shot, float theRange)
    : origin(shot.origin[0], shot.origin[1], shot.origin[2]),
      direction(shot.direction[0], shot.direction[1], shot.direction[2]),
      range(theRange) {
  const glm::vec3& w = direction;
  const float sign = w.z >= 0 ? 1.0f : -1.0f;
  const float a = -1.0f / (sign + w.z);
  const float b = w.x * w.y * a;
  right = glm::vec3(1.0f + sign * w.x * w.x * a, sign * b, -sign * w.x);
  up = glm::vec3(b, sign + w.y * w.y * a, -w.y);
}

void ShotFrame::setFarthest(float metres) {
  slope = range / metres;
  bias = kBiasUnits * range + kBiasShare * metres;
}

glm::vec2 ShotFrame::placeOf(const glm::vec3& q) const {
  const float along = std::max(glm::dot(q, direction), 1e-20f);
  const glm::vec2 place = glm::vec2(glm::dot(q, right), glm::dot(q, up)) / (along * slope);
  const float radius = glm::length(place);
  if (!(radius > 1)) return place;
  return place * (std::min(1.0f + std::log(radius), 0.999f * kMapReach) / radius);
}

bool inSight(const ShotFrame& frame, uint32_t root, const uint32_t* blocks, const glm::vec3& q,
             const glm::vec3& facing) {
  uint32_t word = root;
  if ((word & kNode) != 0) {
    glm::vec2 at = (frame.placeOf(q) + kMapReach) * (2.0f / kMapReach);  // in squares of the root
    while ((word & kNode) != 0) {
      const glm::vec2 square = glm::clamp(glm::floor(at), 0.0f, 3.0f);
      const uint32_t bit = static_cast<uint32_t>(square.y) * 4 + static_cast<uint32_t>(square.x);
      const uint32_t* block = blocks + size_t{word & ~kTag} * 4;
      word = (word & kTag) == kNode ? block[bit] : block[1 + (block[0] >> bit & 1u)];
      at = (at - square) * 4.0f;
    }
  }
  if (word == kOpen) return true;
  const uint32_t* plane = blocks + size_t{word & ~kTag} * 4;
  const glm::vec3 normal(std::bit_cast<float>(plane[0]), std::bit_cast<float>(plane[1]),
                         std::bit_cast<float>(plane[2]));
  const float behind = std::bit_cast<float>(plane[3]) - glm::dot(normal, q);
  // Depth bias. A point of the same surface may lie a little behind the plane of a neighbouring
  // facet; a point of another surface may not. At grazing angles a small distance from the plane is
  // a long one along the ray, which kSlant limits.
  const float bias = frame.bias * glm::clamp((glm::dot(normal, facing) - kOther) / (kSame - kOther),
                                             kLeastBias, 1.0f);
  return behind <= bias && behind * glm::length(q) <= kSlant * bias * std::abs(glm::dot(normal, q));
}

}  // namespace grisaille::sspm
