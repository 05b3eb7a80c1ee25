// SPDX-License-Identifier: MIT
#include "app/report/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <map>

#include "core/scene/view.h"

namespace grisaille::app {
namespace {

constexpr double kLeastCosine = 0.1;

}  // namespace

std::optional<Owned> findOwned(std::span<const effect::Effect* const> effects) {
  for (const effect::Effect* effect : effects) {
    if (effect->objects() == nullptr) continue;
    Owned owned{.effect = effect->desc->key, .overlay = {}, .owner = {}};
    for (const grisaille_output_desc& output : effect->outputs()) {
      const std::string name = owned.effect + "." + output.key;
      if (output.role == GRISAILLE_ROLE_OVERLAY) owned.overlay = name;
      if (output.role == GRISAILLE_ROLE_OWNER) owned.owner = name;
    }
    for (const objects::Field& field : objects::fieldsOf(*effect->objects())) {
      if (field.type == GRISAILLE_FIELD_COLOUR && owned.colour == nullptr) owned.colour = &field;
    }
    if (!owned.overlay.empty() && !owned.owner.empty() && owned.colour != nullptr) return owned;
  }
  return std::nullopt;
}

std::vector<ColorShare> colorShares(const image::Image& owner, const image::Image& overlay,
                                    const image::Image& depth, const image::Image& normal,
                                    const scene::Camera& camera, const objects::View& objects,
                                    const objects::Field& colour) {
  const scene::View view = scene::viewOf(camera, {depth.width, depth.height});
  std::map<std::string, double> areas;
  double nobodys = 0, all = 0;
  for (uint32_t y = 0; y < depth.height; ++y) {
    for (uint32_t x = 0; x < depth.width; ++x) {
      const double z = depth.at(x, y);
      if (z <= 0) continue;
      // The ray has a length of 1 along the view direction.
      const glm::dvec3 ray = scene::rayAt(view, glm::dvec2(x + 0.5, y + 0.5)).direction;
      const glm::dvec3 n(normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2));
      const double length = glm::length(ray);
      const double cosine = std::max(std::abs(glm::dot(n, ray)) / length, kLeastCosine);
      const double scale = scene::depthScale(view, z);
      const double area = scale * scale / (cosine * length);
      const auto own = static_cast<size_t>(owner.at(x, y));
      const double alpha = own == 0 || own > objects.count ? 0.0 : double{overlay.at(x, y, 3)};
      if (alpha > 0) {
        areas[objects::textOf(colour, objects.value(own - 1, colour))] += alpha * area;
      }
      nobodys += (1 - alpha) * area;
      all += area;
    }
  }
  std::vector<ColorShare> shares;
  for (const auto& [color, area] : areas) shares.push_back({color, area / all});
  std::stable_sort(shares.begin(), shares.end(),
                   [](const ColorShare& a, const ColorShare& b) { return a.share > b.share; });
  shares.push_back({"none", all > 0 ? nobodys / all : 1.0});
  return shares;
}

std::string coverageCsv(std::span<const ColorShare> shares) {
  std::string csv = "color,share\n";
  for (const ColorShare& share : shares)
    csv += fmt::format("{},{:.6f}\n", share.color, share.share);
  return csv;
}

}  // namespace grisaille::app
