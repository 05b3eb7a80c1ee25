// SPDX-License-Identifier: MIT
#include "core/frame/facet_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace grisaille::frame {
namespace {

class Depths {
 public:
  Depths(const image::Image& depth, const scene::Camera& camera) : depth_(depth) {
    const double half = std::tan(glm::radians(camera.fovyDegrees) / 2);
    scale_ = 2 * half / depth.height;
    corner_ = half * glm::dvec2(double{1} * depth.width / depth.height, 1);
  }

  // 1/m; 0 for the sky; none outside the picture.
  std::optional<double> inverse(int x, int y) const {
    if (x < 0 || y < 0 || x >= static_cast<int>(depth_.width) ||
        y >= static_cast<int>(depth_.height)) {
      return std::nullopt;
    }
    const float depth = depth_.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
    return depth > 0 ? 1.0 / double{depth} : 0.0;
  }

  // In view space.
  glm::dvec3 position(int x, int y) const {
    const double depth = double{depth_.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y))};
    return depth * glm::dvec3((x + 0.5) * scale_ - corner_.x, corner_.y - (y + 0.5) * scale_, -1);
  }

  // A tangent along one axis, from those three pixels in a row with this one among them whose
  // inverse depths are nearest to a line; none where there is no surface beside it.
  std::optional<glm::dvec3> along(int x, int y, int dx, int dy) const {
    const auto at = [&](int steps) { return inverse(x + steps * dx, y + steps * dy); };
    const auto there = [&](int steps) { return position(x + steps * dx, y + steps * dy); };
    const double here = *at(0);
    std::optional<glm::dvec3> best;
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](double bend, int from, int to) {
      if (bend >= least) return;
      least = bend;
      best = there(to) - there(from);
    };
    const auto before = at(-1), after = at(1);
    const bool both = before && after && *before > 0 && *after > 0;
    if (both) offer(std::abs(*before + *after - 2 * here), -1, 1);
    for (const int side : {1, -1}) {
      const auto first = side > 0 ? after : before, second = at(2 * side);
      if (!first || *first == 0) continue;
      // Where there is no second pixel, whatever else there is tells more.
      const double bend =
          second ? std::abs(here + *second - 2 * *first) : std::numeric_limits<double>::max();
      offer(bend, std::min(side, 0), std::max(side, 0));
    }
    return best;
  }

 private:
  const image::Image& depth_;
  double scale_ = 0;   // of a pixel at a view depth of 1
  glm::dvec2 corner_;  // half the picture there
};

}  // namespace

image::Image facetNormals(const image::Image& viewDepth, const scene::Camera& camera) {
  const Depths depths(viewDepth, camera);
  const glm::dmat3 worldFromView = scene::worldFromView(camera);
  image::Image normals{.width = viewDepth.width,
                       .height = viewDepth.height,
                       .channels = 3,
                       .pixels = std::vector<float>(viewDepth.pixels.size() * 3, 0.0f)};
  for (int y = 0; y < static_cast<int>(viewDepth.height); ++y) {
    for (int x = 0; x < static_cast<int>(viewDepth.width); ++x) {
      if (*depths.inverse(x, y) == 0) continue;
      const auto right = depths.along(x, y, 1, 0), down = depths.along(x, y, 0, 1);
      if (!right || !down) continue;
      glm::dvec3 normal = glm::cross(*down, *right);
      const double length = glm::length(normal);
      if (!(length > 0)) continue;
      normal /= glm::dot(normal, depths.position(x, y)) > 0 ? -length : length;
      const glm::dvec3 world = worldFromView * normal;
      float* out = &normals.pixels[(size_t(y) * viewDepth.width + size_t(x)) * 3];
      for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(world[i]);
    }
  }
  return normals;
}

}  // namespace grisaille::frame
