// SPDX-License-Identifier: MIT
#include "shot_map.h"

#include <glm/gtc/packing.hpp>

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
constexpr float kPerCosine = 1 / (kSame - kOther);
constexpr float kBiasUnits = 0.02f;       // of the range
constexpr float kBiasShare = 2e-5f;       // of the distance
constexpr float kLineReach = 12;          // largest offset of a line on the map
constexpr float kLineSlack = 1.0f / 512;  // units of the map: how far a line may be off

// A normal with |x| + |y| = 1 as a turn, 0 to 4, and back.
float turnOf(const glm::vec2& normal) {
  return normal.y >= 0 ? 1 - normal.x : 3 + normal.x;
}

glm::vec2 normalAt(float turn) {
  const float x = turn < 2 ? 1 - turn : turn - 3;
  return {x, (turn < 2 ? 1.0f : -1.0f) * (1 - std::abs(x))};
}

uint32_t packNormal(const glm::vec3& normal) {
  const glm::vec3 size = glm::abs(normal);
  glm::vec2 flat = glm::vec2(normal) / (size.x + size.y + size.z);
  if (normal.z < 0) {
    const glm::vec2 folded = 1.0f - glm::abs(glm::vec2(flat.y, flat.x));
    flat = {flat.x >= 0 ? folded.x : -folded.x, flat.y >= 0 ? folded.y : -folded.y};
  }
  return glm::packSnorm2x16(flat);
}

glm::vec3 unpackNormal(uint32_t packed) {
  const glm::vec2 flat = glm::unpackSnorm2x16(packed);
  glm::vec3 normal(flat, 1 - std::abs(flat.x) - std::abs(flat.y));
  const float under = std::max(-normal.z, 0.0f);
  normal.x += normal.x >= 0 ? -under : under;
  normal.y += normal.y >= 0 ? -under : under;
  return glm::normalize(normal);
}

}  // namespace

MapBlock packPlane(const glm::vec4& plane) {
  return {packNormal(glm::vec3(plane)), std::bit_cast<uint32_t>(plane.w)};
}

glm::vec4 unpackPlane(const uint32_t* block) {
  return {unpackNormal(block[0]), std::bit_cast<float>(block[1])};
}

glm::vec3 roundedNormal(const glm::vec3& normal) {
  return unpackNormal(packNormal(normal));
}

MapLine lineThrough(const glm::vec2& a, const glm::vec2& b, const glm::vec2& second) {
  glm::vec2 normal(a.y - b.y, b.x - a.x);
  normal /= std::max(std::abs(normal.x) + std::abs(normal.y), 1e-20f);
  const glm::vec2 middle = (a + b) / 2.0f;
  if (glm::dot(normal, second - middle) < 0) normal = -normal;
  normal = normalAt(static_cast<float>(std::lround(turnOf(normal) * 16384) & 0xFFFF) / 16384);
  return {.normal = normal, .offset = glm::dot(normal, middle)};
}

MapBlock packLine(const MapLine& line, uint32_t first, uint32_t second) {
  const auto turn = static_cast<uint32_t>(std::lround(turnOf(line.normal) * 16384)) & 0xFFFFu;
  const float offset = glm::clamp(line.offset / kLineReach, -1.0f, 1.0f) * 32767;
  const auto packed = static_cast<uint32_t>(std::lround(offset)) & 0xFFFFu;
  return {first | second << 16, turn | packed << 16};
}

MapLine unpackLine(const uint32_t* block) {
  const float turn = static_cast<float>(block[1] & 0xFFFFu) / 16384;
  const auto offset = static_cast<float>(static_cast<int16_t>(block[1] >> 16));
  return {.normal = normalAt(turn), .offset = offset * (kLineReach / 32767)};
}

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

// A point of the same surface may lie a little behind the plane of a neighbouring facet; a point of
// another surface may not. At grazing angles a small distance from the plane is a long one along
// the ray, which kSlant limits.
float depthBehind(const ShotFrame& frame, const glm::vec4& plane, const glm::vec3& q,
                  const glm::vec3& facing) {
  const glm::vec3 normal(plane);
  const float behind = plane.w - glm::dot(normal, q);
  const float bias =
      frame.bias * glm::clamp((glm::dot(normal, facing) - kOther) * kPerCosine, kLeastBias, 1.0f);
  if (behind <= 0) return behind / bias;
  const float along = kSlant * std::max(std::abs(glm::dot(normal, q)), 1e-20f) / glm::length(q);
  return behind / (bias * std::min(along, 1.0f));
}

namespace {

// Reference of square `square` of a node, 0 to 15 by rows.
uint32_t squareOf(uint32_t tag, const uint32_t* block, uint32_t square) {
  uint32_t half = square;
  if (tag == kTwo) {
    half = 1 + (block[0] >> square & 1u);
  } else if (tag == kFour) {
    half = 2 + (block[0] >> 2 * square & 3u);
  } else if (tag == kEight) {
    half = 4 + ((square < 10 ? block[0] >> 3 * square : block[1] >> 3 * (square - 10)) & 7u);
  }
  return block[half / 2] >> 16 * (half & 1) & 0xFFFFu;
}

}  // namespace

bool inSight(const ShotFrame& frame, uint32_t root, const uint32_t* words, const glm::vec3& q,
             const glm::vec3& facing) {
  uint32_t at = root, other = root;  // `other`: what lies beyond a line that is close
  if (at >= kLine) {
    const glm::vec2 place = frame.placeOf(q);
    glm::vec2 inSquare = (place + kMapReach) * (2.0f / kMapReach);  // in squares of the root
    while (at >= kLine) {
      const uint32_t* block = words + size_t{at & ~kTag} * 2;
      if ((at & kTag) == kLine) {
        const MapLine line = unpackLine(block);
        const float off = glm::dot(line.normal, place) - line.offset;
        const uint32_t first = block[0] & 0xFFFFu, second = block[0] >> 16;
        at = off > 0 ? second : first;
        other = std::abs(off) >= kLineSlack ? at : off > 0 ? first : second;
        continue;
      }
      const glm::vec2 square = glm::clamp(glm::floor(inSquare), 0.0f, 3.0f);
      at = squareOf(at & kTag, block,
                    static_cast<uint32_t>(square.y) * 4 + static_cast<uint32_t>(square.x));
      other = at;
      inSquare = (inSquare - square) * 4.0f;
    }
  }
  const auto isBefore = [&](uint32_t leaf) {
    return leaf == kOpen ||
           depthBehind(frame, unpackPlane(words + size_t{leaf - 1} * 2), q, facing) <= 1;
  };
  return isBefore(at) || (other != at && isBefore(other));
}

}  // namespace grisaille::sspm
