// SPDX-License-Identifier: MIT
// What a muzzle sees, in depth pictures that the host draws. They answer a survey's rays.
//
// Five pictures share the muzzle and the shot's direction. Each is about 4.6 times as wide as the
// next, so that a point at the distance d of the ray is seen with pixels of at most d / 28: fine
// along the ray, coarse beside the muzzle.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "shot_map.h"

namespace grisaille::sspm {

// Draws one picture: grisaille_host::draw_depth. Returns false if the host draws none.
using DrawDepth = std::function<bool(const grisaille_depth_view&, std::span<float>)>;

class Muzzle {
 public:
  static constexpr uint32_t kSize = 256;  // pixels
  static constexpr std::array<float, 5> kSlopes = {4, 0.88f, 0.19f, 0.042f, 0.0092f};

  static constexpr uint64_t kBytes = kSlopes.size() * kSize * kSize * sizeof(float);

  // Asks the host for the pictures. Null if it draws none.
  static std::optional<Muzzle> look(const ShotFrame& frame, const DrawDepth& draw);

  // Whether the host could tell anything yet.
  bool isKnown() const;
  // What the first surface along a ray is. The ray starts at the muzzle.
  grisaille_hit see(const grisaille_ray& ray) const;

 private:
  using Nearness = std::vector<float>;  // reciprocal of the depth; linear across a plane

  explicit Muzzle(const ShotFrame& frame)
      : right_(glm::cross(frame.direction, frame.up)), up_(frame.up), direction_(frame.direction) {}

  static float slant(const Nearness& picture, int32_t at, int32_t step, int32_t before,
                     int32_t after);

  glm::vec3 right_, up_, direction_;
  std::array<Nearness, kSlopes.size()> pictures_;
};

}  // namespace grisaille::sspm
