// SPDX-License-Identifier: MIT
#include "lab/oracle/facet.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace grisaille::lab::oracle {
namespace {

constexpr double kPlaneTolerance = 0.05;  // radii
// Deviations from a line, pixel widths: the weight of three pixels in a row falls to a half at the
// first, and the interpolated normal has the weight of the second.
constexpr double kLeastBend = 0.01, kNormalBend = 0.1;

// Increase per pixel along an axis of a function of view depth that is linear in the pixels of a
// plane. Each three pixels in a row that hold the pixel give one; those near a line weigh most.
// `straight`: factor from deviations to pixel widths. `byNormal`: the increase on the plane of the
// interpolated normal.
double slopeAlong(const View& view, const glm::ivec2& pixel, const glm::ivec2& along,
                  double straight, double byNormal) {
  const auto depthAt = [&](int i) {
    const glm::ivec2 at = pixel + i * along;
    return view.holds(at) ? view.depth(at) : 0;
  };
  const auto linear = [&](int i) {
    return view.orthographic() ? depthAt(i) : -1 / std::max(depthAt(i), 1e-30);
  };
  double weights = 1 / (kNormalBend * kNormalBend), sum = weights * byNormal;
  for (int first = -2; first <= 0; ++first) {
    if (depthAt(first) <= 0 || depthAt(first + 1) <= 0 || depthAt(first + 2) <= 0) continue;
    const double bend = (linear(first) + linear(first + 2) - 2 * linear(first + 1)) * straight;
    const double weight = 1 / (bend * bend + kLeastBend * kLeastBend);
    const int from = first == 0 ? 0 : -1, to = first == -2 ? 0 : 1;
    weights += weight;
    sum += weight * (linear(to) - linear(from)) / (to - from);
  }
  return sum / weights;
}

}  // namespace

Facet::Facet(const View& view, const glm::ivec2& pixel, double pixels, double radius, bool stored)
    : position_(view.position(pixel)) {
  const double shrink = view.shrink(view.depth(pixel));
  const glm::dvec3 normal = view.normal(pixel), ray = view.ray(glm::dvec2(pixel) + 0.5);
  const double facing = std::min(glm::dot(normal, ray), -0.01);
  const glm::dvec2 across = 1.0 / view.focal();
  const double width = shrink * std::abs(across.x);  // of a pixel, metres
  const double straight = shrink * std::abs(facing / across.x);
  const glm::dvec2 byNormal = -glm::dvec2(normal) / facing * across / shrink;
  // Metres of view depth per metre across.
  glm::dvec2 tangent = -shrink / across *
                       glm::dvec2(slopeAlong(view, pixel, {1, 0}, straight, byNormal.x),
                                  slopeAlong(view, pixel, {0, 1}, straight, byNormal.y));
  if (stored) {
    const glm::vec2 limited = glm::clamp(glm::vec2(tangent), -6e4f, 6e4f);
    tangent = glm::unpackHalf2x16(glm::packHalf2x16(limited));
  }
  normal_ = glm::normalize(glm::dvec3(tangent, glm::dot(tangent, glm::dvec2(ray)) - 1));
  tolerance_ = std::min(kPlaneTolerance * radius, pixels * width);
}

double Facet::off(const View& view, const glm::ivec2& pixel, double depth) const {
  return std::abs(glm::dot(view.position(pixel, depth) - position_, normal_)) / tolerance_;
}

}  // namespace grisaille::lab::oracle
