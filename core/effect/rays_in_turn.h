// SPDX-License-Identifier: MIT
// Rays that one service cannot tell are asked of another: of a frame's depth first, say, and then
// of the scene.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/effect/instance.h"

namespace grisaille::effect {

class RaysInTurn : public RayService {
 public:
  // Neither is null.
  RaysInTurn(std::unique_ptr<RayService> first, std::unique_ptr<RayService> second)
      : first_(std::move(first)), second_(std::move(second)) {}

  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override {
    first_->cast(rays, hits);
    std::vector<grisaille_ray> left;
    for (size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].kind == GRISAILLE_HIT_UNKNOWN) left.push_back(rays[i]);
    }
    std::vector<grisaille_hit> answers(left.size());
    if (!left.empty()) second_->cast(left, answers);
    auto answer = answers.begin();
    for (grisaille_hit& hit : hits) {
      if (hit.kind == GRISAILLE_HIT_UNKNOWN) hit = *answer++;
    }
  }

 private:
  std::unique_ptr<RayService> first_, second_;
};

}  // namespace grisaille::effect
