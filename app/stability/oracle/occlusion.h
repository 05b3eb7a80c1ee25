// SPDX-License-Identifier: MIT
// The ambient visibility of effects/ssao/README.md once more, in double precision.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "app/stability/oracle/view.h"

namespace grisaille::app::stability {

// The effect's parameters, lengths in metres.
struct OcclusionSettings {
  bool classic = false;
  double radius = 0.5;
  int slices = 1, edgeSlices = 1, steps = 6;
  double thickness = 0.7;  // radii
  int scale = 2;           // pixels a texel: 1, 2 or 4
  int blurSize = 4;
  double intensity = 1, power = 1;
  double albedo = 0;  // of the bounce; 0: none
  uint32_t seed = 0;
  int kernelSize = 64;
  double bias = 0.01;
  bool biasAlone = false;  // classic: without the roundings, points where they project
  bool sphere = false, rotated = true, edgeAware = false;
  enum class Range { kLinear, kRawDepth, kNone } range = Range::kLinear;
};

// Works out only what is asked for, and that once. Not for two threads at a time.
class Occlusion {
 public:
  virtual ~Occlusion() = default;
  // Of a pixel of the picture, 0 to 1.
  virtual double visibility(const glm::ivec2& pixel) = 0;
};

// `view` outlives the result.
std::unique_ptr<Occlusion> makeOcclusion(const View& view, const OcclusionSettings& settings);

// What the last pass does: intensity, bounced light, power.
double finished(double open, const OcclusionSettings& settings);

// A picture whose pixels are worked out when they are asked for; beyond its edge the nearest one.
class Lazy {
 public:
  using Source = std::function<double(const glm::ivec2&)>;
  Lazy(const glm::ivec2& size, Source source);

  const glm::ivec2& size() const { return size_; }
  double operator()(const glm::ivec2& pixel);

 private:
  glm::ivec2 size_;
  Source source_;
  std::vector<double> values_;  // NaN: not asked for yet
};

std::unique_ptr<Occlusion> makeClassic(const View& view, const OcclusionSettings& settings);
std::unique_ptr<Occlusion> makeSlices(const View& view, const OcclusionSettings& settings);

}  // namespace grisaille::app::stability
