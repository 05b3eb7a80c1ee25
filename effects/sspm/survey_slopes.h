// SPDX-License-Identifier: MIT
// Places on a shot's map, and the rays through them.
#pragma once

#include <cmath>
#include <limits>

#include "shot_map.h"

namespace grisaille::sspm {

constexpr int32_t kFinestAUnit = 256;  // finest squares in a unit of the map
// Width of the squares of a coarse map that are leaves, whatever they see; in finest squares.
constexpr int32_t kCoarseLeast = kFinestAUnit / 8;
constexpr float kBeyond = 1.02f;  // times the range: hits beyond it are outside the cylinder
// Times the range: how far rays reach, so that squares across the cylinder's rim know all corners.
constexpr float kReach = 1.4f;

// Place of a corner of finest squares, which it counts from the map's lower corner, in units.
inline glm::vec2 unitsOf(const glm::ivec2& corner) {
  return glm::vec2(corner) / static_cast<float>(kFinestAUnit) - kMapReach;
}

inline glm::vec2 slopeOf(const ShotFrame& frame, const glm::vec2& place) {
  const float radius = glm::length(place);
  if (radius <= 1) return place * frame.slope;
  return place * (frame.slope * std::exp(radius - 1) / radius);
}

// Offset of length 1 along the shot's direction.
inline glm::vec3 alongSlope(const ShotFrame& frame, const glm::vec2& slope) {
  return slope.x * frame.right + slope.y * frame.up + frame.direction;
}

// Reciprocal of the distance, along the shot's direction, of a plane at a place of the map. It
// changes linearly across the map where slopes do.
inline float nearness(const ShotFrame& frame, const glm::vec4& plane, const glm::vec2& place) {
  const glm::vec3 along = alongSlope(frame, slopeOf(frame, place));
  return glm::dot(glm::vec3(plane), along) / plane.w;
}

// Distance along the shot's direction at which a slope leaves the cylinder, metres.
inline float exitOf(const ShotFrame& frame, const glm::vec2& slope) {
  const float length = glm::length(slope);
  return length > 0 ? kBeyond * frame.range / length : std::numeric_limits<float>::infinity();
}

// The ray through a place, as far as the cylinder.
inline grisaille_ray rayTo(const ShotFrame& frame, const glm::vec2& place) {
  const glm::vec2 slope = slopeOf(frame, place);
  const glm::vec3 along = alongSlope(frame, slope);
  const float length = glm::length(along);
  const glm::vec3 unit = along / length;
  return {.origin = {frame.origin.x, frame.origin.y, frame.origin.z},
          .direction = {unit.x, unit.y, unit.z},
          .reach = exitOf(frame, slope) * (kReach / kBeyond) * length};
}

}  // namespace grisaille::sspm
