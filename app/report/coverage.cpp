// SPDX-License-Identifier: MIT
#include "app/report/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/color_space.hpp>
#include <map>

namespace grisaille::app {
namespace {

constexpr double kLeastCosine = 0.1;

std::string hexOf(const grisaille_shot& shot) {
  const glm::vec3 linear(shot.color[0], shot.color[1], shot.color[2]);
  const glm::uvec3 bytes(glm::round(glm::convertLinearToSRGB(linear) * 255.0f));
  return fmt::format("#{:02x}{:02x}{:02x}", bytes.x, bytes.y, bytes.z);
}

}  // namespace

std::optional<Painter> findPainter(std::span<const effect::Effect* const> effects) {
  for (const effect::Effect* effect : effects) {
    Painter painter{.effect = effect->desc->key, .paint = {}, .owner = {}};
    for (const grisaille_output_desc& output : effect->outputs()) {
      const std::string name = painter.effect + "." + output.key;
      if (output.role == GRISAILLE_ROLE_PAINT) painter.paint = name;
      if (output.role == GRISAILLE_ROLE_OWNER) painter.owner = name;
    }
    if (!painter.paint.empty() && !painter.owner.empty()) return painter;
  }
  return std::nullopt;
}

std::vector<ColorShare> colorShares(const image::Image& owner, const image::Image& paint,
                                    const image::Image& depth, const image::Image& normal,
                                    const scene::Camera& camera,
                                    std::span<const grisaille_shot> shots) {
  std::map<std::string, double> areas;
  double unpainted = 0, all = 0;
  for (uint32_t y = 0; y < depth.height; ++y) {
    for (uint32_t x = 0; x < depth.width; ++x) {
      const double z = depth.at(x, y);
      if (z <= 0) continue;
      // Its length is 1 along the view direction.
      const glm::dvec3 ray =
          scene::pixelDirection(camera, depth.width, depth.height, glm::dvec2(x + 0.5, y + 0.5));
      const glm::dvec3 n(normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2));
      const double length = glm::length(ray);
      const double cosine = std::max(std::abs(glm::dot(n, ray)) / length, kLeastCosine);
      const double area = z * z / (cosine * length);
      const auto shot = static_cast<size_t>(owner.at(x, y));
      const double alpha = shot == 0 || shot > shots.size() ? 0.0 : double{paint.at(x, y, 3)};
      if (alpha > 0) areas[hexOf(shots[shot - 1])] += alpha * area;
      unpainted += (1 - alpha) * area;
      all += area;
    }
  }
  std::vector<ColorShare> shares;
  for (const auto& [color, area] : areas) shares.push_back({color, area / all});
  std::stable_sort(shares.begin(), shares.end(),
                   [](const ColorShare& a, const ColorShare& b) { return a.share > b.share; });
  shares.push_back({"none", all > 0 ? unpainted / all : 1.0});
  return shares;
}

std::string coverageCsv(std::span<const ColorShare> shares) {
  std::string csv = "color,share\n";
  for (const ColorShare& share : shares)
    csv += fmt::format("{},{:.6f}\n", share.color, share.share);
  return csv;
}

}  // namespace grisaille::app
