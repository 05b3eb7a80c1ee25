// SPDX-License-Identifier: MIT
#include "app/report/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace grisaille::app {

std::optional<Owned> findOwned(std::span<const effect::Effect* const> effects) {
  for (const effect::Effect* effect : effects) {
    if (effect->objects() == nullptr || effect->desc->draw_at == nullptr) continue;
    for (const objects::Field& field : objects::fieldsOf(*effect->objects())) {
      if (field.type == GRISAILLE_FIELD_COLOUR) return Owned{effect->desc->key, &field};
    }
  }
  return std::nullopt;
}

Coverage coverageOf(effect::Chain& chain, const Owned& owned, SceneRays& rays,
                    const CoverageSpec& spec) {
  const trace::SurfacePoints surface =
      rays.surface({.count = spec.points, .steepest = spec.steepest, .seed = 1});
  std::vector<grisaille_drawn> drawn(surface.points.size());
  chain.drawAt(*chain.selection.find(owned.effect),
               {.points = surface.points, .drawn = drawn, .rays = &rays});
  const objects::View objects = chain.objects(owned.effect)->view();
  std::map<uint64_t, double> byOwner;
  for (const grisaille_drawn& one : drawn) byOwner[one.owner] += double{one.alpha};
  std::map<std::string, double> byColor;
  double covered = 0;
  for (const auto& [owner, sum] : byOwner) {
    if (owner == 0) continue;
    const objects::Value value = objects.value(static_cast<size_t>(owner) - 1, *owned.colour);
    byColor[objects::textOf(*owned.colour, value)] += sum;
    covered += sum;
  }
  const double all = std::max(static_cast<double>(drawn.size()), 1.0);
  Coverage coverage = {.shares = {}, .points = drawn.size(), .area = surface.area};
  for (const auto& [color, sum] : byColor) coverage.shares.push_back({color, sum / all});
  std::ranges::stable_sort(coverage.shares, std::ranges::greater(), &ColorShare::share);
  coverage.shares.push_back({"none", 1 - covered / all});
  return coverage;
}

std::string coverageCsv(std::span<const ColorShare> shares) {
  std::string csv = "color,share\n";
  for (const ColorShare& share : shares)
    csv += fmt::format("{},{:.6f}\n", share.color, share.share);
  return csv;
}

}  // namespace grisaille::app
