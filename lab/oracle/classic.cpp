// SPDX-License-Identifier: MIT
// The estimator `classic` of effects/ssao/README.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <utility>

#include "lab/oracle/occlusion.h"

namespace grisaille::lab::oracle {
namespace {

constexpr double kDepthRounding = 5e-7;    // view depths
constexpr double kNormalRounding = 5e-4;   // radians
constexpr double kPlaceRounding = 2.5e-7;  // picture sizes

// PCG hash: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
uint32_t pcg(uint32_t value) {
  const uint32_t state = value * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

double wrappedToUnit(double value) {
  return value - std::floor(value);
}

// Sample points in the unit sphere or hemisphere: the R3 sequence (Roberts 2018), from a start that
// the seed draws, gives their directions and distances.
std::vector<glm::dvec3> samplePoints(const OcclusionSettings& settings) {
  constexpr double kPlastic = 1.2207440846057596;
  uint32_t state = pcg(settings.seed ^ pcg(0));
  glm::dvec3 start(0);
  for (const int axis : {2, 1, 0}) {
    state = pcg(state);
    start[axis] = state * 0x1p-32;
  }
  std::vector<glm::dvec3> points;
  for (int i = 0; i < settings.kernelSize; ++i) {
    const double u = wrappedToUnit(start.x + i / kPlastic);
    const double v = wrappedToUnit(start.y + i / (kPlastic * kPlastic));
    const double w = wrappedToUnit(start.z + i / (kPlastic * kPlastic * kPlastic));
    const double z = settings.sphere ? 1 - 2 * u : std::sqrt(1 - u);
    const double across = std::sqrt(std::max(0.0, 1 - z * z));
    const double angle = glm::two_pi<double>() * v;
    points.push_back(w * glm::dvec3(across * std::cos(angle), across * std::sin(angle), z));
  }
  // Beyond 256 points, the same again, turned by the golden section of a circle.
  for (size_t i = 256; i < points.size(); ++i) {
    const double angle = glm::two_pi<double>() * 0.6180339887498949 * static_cast<double>(i / 256);
    const glm::dvec3 first = points[i % 256];
    const glm::dvec2 turned = first.x * glm::dvec2(std::cos(angle), std::sin(angle)) +
                              first.y * glm::dvec2(-std::sin(angle), std::cos(angle));
    points[i] = glm::dvec3(turned, first.z);
  }
  return points;
}

// The angles of a 4x4 pattern, in sixteenths of the circle, by rows.
std::array<int, 16> rotations(uint32_t seed) {
  std::array<int, 16> angles{};
  std::iota(angles.begin(), angles.end(), 0);
  uint32_t state = pcg(seed ^ pcg(1));
  for (uint32_t i = 15; i > 0; --i) {
    state = pcg(state);
    std::swap(angles[i], angles[state % (i + 1)]);
  }
  return angles;
}

class Classic : public Occlusion {
 public:
  Classic(const View& view, const OcclusionSettings& settings)
      : view_(view),
        settings_(settings),
        points_(samplePoints(settings)),
        rotations_(rotations(settings.seed)),
        raw_(view.size(), [this](const glm::ivec2& pixel) { return estimate(pixel); }) {}

  double visibility(const glm::ivec2& pixel) override {
    double open = raw_(pixel);
    if (settings_.blurSize > 1) open = blurred(pixel);
    return finished(open, settings_);
  }
  glm::dvec3 bentNormal(const glm::ivec2& pixel) override {
    if (!slices_) slices_ = makeSlices(view_, settings_, nullptr);
    return slices_->bentNormal(pixel);
  }
  std::shared_ptr<const Past> past() override { return nullptr; }

 private:
  double estimate(const glm::ivec2& pixel) const {
    const double depth = view_.depth(pixel);
    if (depth <= 0) return 1;
    glm::dmat3 axes(1);
    const glm::dvec3 up = settings_.sphere ? glm::dvec3(0, 0, 1) : view_.normal(pixel);
    if (!settings_.sphere) axes = axesAbout(up);
    if (settings_.rotated) {
      const int index = (pixel.y & 3) * 4 + (pixel.x & 3);
      const double angle = glm::two_pi<double>() * rotations_[static_cast<size_t>(index)] / 16;
      const double c = std::cos(angle), s = std::sin(angle);
      axes = glm::dmat3(c * axes[0] + s * axes[1], c * axes[1] - s * axes[0], axes[2]);
    }
    const std::optional<Raised> raised = raisedBy(view_, pixel, up, settings_.bias);
    if (!raised) return 1;
    const glm::dvec3 position = raised->position;
    const Own own = ownOf(pixel);
    int occluded = 0;
    for (const glm::dvec3& point : points_) {
      occluded += isOccluded(position, settings_.radius * (axes * point), own) ? 1 : 0;
    }
    return 1 - static_cast<double>(occluded) / static_cast<double>(points_.size());
  }

  // The tolerances that keep a surface from occluding itself.
  struct Own {
    double tolerance = 0;  // metres that an occluder must be nearer than the sample point
    // Change per pixel of the raised plane's inverse view depth; orthographic: of minus its depth.
    glm::dvec2 slope{0};
  };

  Own ownOf(const glm::ivec2& pixel) const {
    if (settings_.depthBias) return {.tolerance = *settings_.depthBias};
    const double depth = view_.depth(pixel), rounding = depth * kDepthRounding;
    if (settings_.sphere) return {.tolerance = rounding};
    const glm::dvec3 normal = view_.normal(pixel);
    const double facing = std::max(-glm::dot(normal, view_.ray(glm::dvec2(pixel) + 0.5)), 1e-3);
    const bool parallel = view_.orthographic();
    // From the plane to the eye.
    const double away = parallel ? facing : facing * depth;
    const double raised = parallel ? 0 : std::min(settings_.bias, 0.999 * away);
    const glm::dvec2 slope = -glm::dvec2(normal) / view_.focal() / (away - raised);
    const double turned = kNormalRounding / facing;
    const double aside = turned / view_.focal().x / facing, shrink = view_.shrink(depth);
    const double place =
        shrink * kPlaceRounding * glm::dot(glm::abs(slope), glm::dvec2(view_.size()));
    const double angles = parallel ? turned : turned + aside;
    return {.tolerance = rounding + settings_.radius * angles + shrink * (aside + place),
            .slope = slope};
  }

  bool isOccluded(const glm::dvec3& position, const glm::dvec3& offset, const Own& own) const {
    const glm::dvec3 point = position + offset;
    const double depth = -position.z;
    const double pointDepth = -point.z;
    if (pointDepth <= view_.nearPlane()) return false;  // no surface is nearer
    const glm::dvec2 at = view_.pixelOf(point);
    // Avoids integer overflow. Outside the picture, depth() returns the nearest pixel anyway.
    const glm::dvec2 whole = glm::clamp(glm::floor(at), -1e6, 1e6);
    const double surface = view_.depth(glm::ivec2(whole));
    if (surface <= 0) return false;
    // Moves the point along the surface's plane to the centre of the pixel that depth() read.
    const glm::dvec2 tap = glm::clamp(whole + 0.5, glm::dvec2(0.5), glm::dvec2(view_.size()) - 0.5);
    const double turned = view_.shrink(pointDepth) * glm::dot(own.slope, tap - at);
    if (!(surface + view_.shrink(surface) * turned < pointDepth - own.tolerance)) return false;
    using Range = OcclusionSettings::Range;
    if (settings_.range == Range::kLinear) return surface > depth - settings_.radius;
    if (settings_.range == Range::kNone) return true;
    const auto clip = [&](double metres) { return scene::clipDepthOf(view_.camera(), metres); };
    return std::abs(clip(depth) - clip(surface)) < settings_.radius;
  }

  double blurred(const glm::ivec2& pixel) {
    const double depth = view_.depth(pixel);
    if (depth <= 0) return 1;
    double sum = 0, weights = 0;
    for (int y = 0; y < settings_.blurSize; ++y) {
      for (int x = 0; x < settings_.blurSize; ++x) {
        const glm::ivec2 other = pixel + glm::ivec2(x, y) - settings_.blurSize / 2;
        const double off = std::abs(view_.depth(other) - depth) / settings_.radius;
        const double weight = settings_.edgeAware ? std::max(0.0, 1 - off) : 1;
        sum += weight * raw_(other);
        weights += weight;
      }
    }
    return sum / weights;
  }

  const View& view_;
  OcclusionSettings settings_;
  std::vector<glm::dvec3> points_;
  std::array<int, 16> rotations_;
  Lazy<double> raw_;
  std::unique_ptr<Occlusion> slices_;  // computes the bent normals
};

}  // namespace

std::unique_ptr<Occlusion> makeClassic(const View& view, const OcclusionSettings& settings) {
  return std::make_unique<Classic>(view, settings);
}

}  // namespace grisaille::lab::oracle
