// SPDX-License-Identifier: MIT
#include "app/services/scene_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/scene/depth_sketch.h"
#include "core/scene/view.h"

namespace grisaille::app {
namespace {

// Size of the sketch of a scene, pixels. Its shape is that of the default picture.
constexpr glm::uvec2 kSketch = glm::uvec2(160, 90);
// Most pixels of a row or a column of a picture that count.
constexpr uint32_t kMostPixels = 512;
// Share of the points that lie beyond each end of the extent: a few distant surfaces do not count.
constexpr double kTail = 0.05;
// The radius of ambient occlusion, as a share of the extent. The studies' scenes, from a chess
// board to a street, use radii from 0.4 to 1.9 times this.
constexpr double kShare = 1.0 / 40;

// The nearest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten.
double readable(double length) {
  constexpr double kSteps[] = {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
  const double power = std::floor(std::log10(length));
  const double head = length / std::pow(10, power);
  const auto apart = [&](double step) { return std::abs(std::log(step / head)); };
  const double step = *std::ranges::min_element(kSteps, {}, apart);
  // The nearest double to the decimal number.
  return std::stod(fmt::format("{}e{}", step, power));
}

// The extent of values without their tails.
double extentOf(std::vector<double>& values) {
  const auto tail = static_cast<ptrdiff_t>(kTail * static_cast<double>(values.size() - 1));
  const auto low = values.begin() + tail, high = values.end() - 1 - tail;
  std::nth_element(values.begin(), low, values.end());
  const double least = *low;
  std::nth_element(values.begin(), high, values.end());
  return *high - least;
}

// Calls `use` for each length of an active effect that nobody has set.
template <typename Use>
void forEachFollowing(const effect::Selection& selection, Use&& use) {
  for (const effect::Selection::Entry& entry : selection.entries()) {
    for (const grisaille_param_desc& param : entry.effect().params()) {
      if (entry.on && effect::followsScene(entry.values, param)) use(entry, param);
    }
  }
}

bool anyFollows(const effect::Selection& selection) {
  bool any = false;
  forEachFollowing(selection, [&](const auto&, const auto&) { any = true; });
  return any;
}

}  // namespace

std::optional<double> suitableRadius(const image::Image& depth, const scene::Camera& camera) {
  std::array<std::vector<double>, 3> places;  // along each axis of the world, from the eye
  const scene::View view = scene::viewOf(camera, {depth.width, depth.height});
  const uint32_t across = (depth.width + kMostPixels - 1) / kMostPixels;
  const uint32_t down = (depth.height + kMostPixels - 1) / kMostPixels;
  for (uint32_t y = down / 2; y < depth.height; y += down) {
    for (uint32_t x = across / 2; x < depth.width; x += across) {
      const double metres = double{depth.at(x, y)};
      if (!(metres > 0)) continue;
      const glm::dvec3 point = scene::worldPosition(view, {x + 0.5, y + 0.5}, metres) - view.eye;
      for (int axis = 0; axis < 3; ++axis) places[static_cast<size_t>(axis)].push_back(point[axis]);
    }
  }
  if (places[0].empty()) return std::nullopt;
  const double extent = std::hypot(extentOf(places[0]), extentOf(places[1]), extentOf(places[2]));
  const double radius = kShare * extent;
  if (!std::isnormal(radius)) return std::nullopt;
  return readable(radius);
}

double suitableRadius(const scene::Scene& scene) {
  const scene::Camera camera = scene::defaultCamera(scene, double{1} * kSketch.x / kSketch.y);
  const auto seen = suitableRadius(scene::sketchDepth(scene, camera, kSketch.x, kSketch.y), camera);
  if (seen) return *seen;
  const double radius = kShare * glm::length(scene.bounds.max - scene.bounds.min);
  return std::isnormal(radius) ? readable(radius) : kUsualRadius;
}

double lengthAt(const grisaille_param_desc& param, double radius) {
  const double scaled = param.default_value * (radius / kUsualRadius);
  // A scene of the usual size keeps the table's digits.
  const double length = radius == kUsualRadius ? scaled : std::stod(fmt::format("{:.2g}", scaled));
  return std::clamp(length, param.hard_min, param.hard_max);
}

void fitLengths(effect::Selection& selection, double radius) {
  for (effect::Selection::Entry& entry : selection.entries()) {
    for (const grisaille_param_desc& param : entry.effect().params()) {
      if ((param.flags & GRISAILLE_PARAM_SCENE_LENGTH) == 0) continue;
      entry.values.fit(param.key, lengthAt(param, radius));
    }
  }
}

std::vector<effect::ParameterValue> lengthsOf(const effect::Selection& selection) {
  std::vector<effect::ParameterValue> lengths;
  forEachFollowing(selection, [&](const effect::Selection::Entry& entry, const auto& param) {
    lengths.push_back({{.effect = entry.key(), .key = param.key}, entry.values.get(param.key)});
  });
  return lengths;
}

void fitToScene(effect::Selection& selection, const scene::Scene& scene) {
  if (!anyFollows(selection)) return;
  fitLengths(selection, suitableRadius(scene));
  printChosen(selection, {}, "the scene");
}

void fitToDepth(effect::Selection& selection, const image::Image& depth,
                const scene::Camera& camera) {
  if (!anyFollows(selection)) return;
  fitLengths(selection, suitableRadius(depth, camera).value_or(kUsualRadius));
  printChosen(selection, {}, "the depth");
}

void printChosen(const effect::Selection& selection, std::optional<double> radius,
                 const std::string& what) {
  std::string values, option;
  const auto add = [&](const std::string& name, const std::string& value, const std::string& set) {
    values += fmt::format("{}{} = {} m", values.empty() ? "" : ", ", name, value);
    if (option.empty()) option = set;
  };
  forEachFollowing(selection, [&](const effect::Selection::Entry& entry, const auto& param) {
    if (entry.values.get(param.key) == param.default_value) return;
    const std::string name = fmt::format("{}.{}", entry.key(), param.key);
    add(name, entry.values.text(param.key),
        fmt::format("--set {}={}", name, effect::textOf(param, param.default_value)));
  });
  if (radius && *radius != kUsualRadius) {
    add("--radius", fmt::format("{}", *radius), fmt::format("--radius {}", kUsualRadius));
  }
  if (!values.empty())
    fmt::print(stderr, "note: {}, chosen for {}; {} sets it\n", values, what, option);
}

}  // namespace grisaille::app
