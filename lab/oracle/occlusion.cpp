// SPDX-License-Identifier: MIT
#include "lab/oracle/occlusion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grisaille::lab::oracle {

namespace {

// Jimenez et al. 2016, their fit to path-traced scenes.
double bounced(double open, double albedo) {
  const double a = 2.0404 * albedo - 0.3324;
  const double b = 4.7951 * albedo - 0.6417;
  const double c = 2.7552 * albedo + 0.6903;
  return std::min(std::max(open, ((open * a - b) * open + c) * open), 1.0);
}

}  // namespace

double finished(double open, const OcclusionSettings& settings) {
  open = std::clamp(1 - settings.intensity * (1 - open), 0.0, 1.0);
  if (settings.albedo > 0) open = bounced(open, settings.albedo);
  return std::pow(open, settings.power);
}

glm::dvec3 tintOf(Occlusion& occlusion, const View& view, const OcclusionSettings& settings,
                  const glm::ivec2& pixel) {
  const double open = occlusion.visibility(pixel);
  if (!settings.baseColour) return glm::dvec3(open);
  const glm::dvec3 colour = view.colour(pixel);
  return {bounced(open, colour.x), bounced(open, colour.y), bounced(open, colour.z)};
}

std::optional<Raised> raisedBy(const View& view, const glm::ivec2& pixel, const glm::dvec3& normal,
                               double bias) {
  const glm::dvec3 position = view.position(pixel) + bias * normal;
  if (bias > 0 && -position.z <= view.nearPlane()) return std::nullopt;
  return Raised{position, view.pixelOf(position) - 0.5};
}

std::unique_ptr<Occlusion> makeOcclusion(const View& view, const OcclusionSettings& settings,
                                         std::shared_ptr<const Past> past) {
  return settings.classic ? makeClassic(view, settings)
                          : makeSlices(view, settings, std::move(past));
}

}  // namespace grisaille::lab::oracle
