// SPDX-License-Identifier: MIT
#include "app/stability/oracle/occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grisaille::app::stability {

Lazy::Lazy(const glm::ivec2& size, Source source)
    : size_(size),
      source_(std::move(source)),
      values_(static_cast<size_t>(size.x) * static_cast<size_t>(size.y),
              std::numeric_limits<double>::quiet_NaN()) {}

double Lazy::operator()(const glm::ivec2& pixel) {
  const glm::ivec2 at = glm::clamp(pixel, glm::ivec2(0), size_ - 1);
  double& value =
      values_[static_cast<size_t>(at.y) * static_cast<size_t>(size_.x) + static_cast<size_t>(at.x)];
  if (std::isnan(value)) value = source_(at);
  return value;
}

double finished(double open, const OcclusionSettings& settings) {
  open = std::clamp(1 - settings.intensity * (1 - open), 0.0, 1.0);
  if (settings.albedo > 0) {
    // Jimenez et al. 2016, their fit to path-traced scenes.
    const double a = 2.0404 * settings.albedo - 0.3324;
    const double b = 4.7951 * settings.albedo - 0.6417;
    const double c = 2.7552 * settings.albedo + 0.6903;
    open = std::min(std::max(open, ((open * a - b) * open + c) * open), 1.0);
  }
  return std::pow(open, settings.power);
}

std::unique_ptr<Occlusion> makeOcclusion(const View& view, const OcclusionSettings& settings) {
  return settings.classic ? makeClassic(view, settings) : makeSlices(view, settings);
}

}  // namespace grisaille::app::stability
