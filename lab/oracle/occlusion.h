// SPDX-License-Identifier: MIT
// The ambient visibility of effects/ssao/README.md once more, in double precision.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "lab/oracle/view.h"

namespace grisaille::lab::oracle {

// The effect's parameters, lengths in metres.
struct OcclusionSettings {
  bool classic = false;
  double radius = 0.5;
  int slices = 1, edgeSlices = 1, steps = 6;
  double thickness = 0.7;             // radii
  bool backFaces = false;             // the thickness is the view's where it has one
  int history = 1;                    // frames; needs a Past from the second frame on
  int scale = 2;                      // pixels a texel: 1, 2 or 4
  int denoiseSize = 5, blurSize = 4;  // slices and classic
  int edgeDenoise = 6;
  double intensity = 1, power = 1;
  double albedo = 0;        // of the bounce; 0: none
  bool baseColour = false;  // the tint bounces light off the view's
  uint32_t seed = 0;
  int kernelSize = 64;
  double bias = 0.01;
  bool biasAlone = false;  // classic: without the roundings, points where they project
  bool sphere = false, rotated = true, edgeAware = false;
  enum class Range { kLinear, kRawDepth, kNone } range = Range::kLinear;
};

// What slices had averaged of the frames up to one, for the frame after.
class Past {
 public:
  virtual ~Past() = default;
};

// Works out only what is asked for, and that once. Not for two threads at a time.
class Occlusion {
 public:
  virtual ~Occlusion() = default;
  // Of a pixel of the picture, 0 to 1.
  virtual double visibility(const glm::ivec2& pixel) = 0;
  // World, length 1; slices alone have one.
  virtual glm::dvec3 bentNormal(const glm::ivec2& pixel) = 0;
  // Slices with a history; everything is worked out.
  virtual std::shared_ptr<const Past> past() = 0;
};

// By channel, 0 to 1.
glm::dvec3 tintOf(Occlusion& occlusion, const View& view, const OcclusionSettings& settings,
                  const glm::ivec2& pixel);

// `view` outlives the result, and what follows from it. `past`: of the frame before; none: the
// first.
std::unique_ptr<Occlusion> makeOcclusion(const View& view, const OcclusionSettings& settings,
                                         std::shared_ptr<const Past> past = nullptr);

// What the last pass does: intensity, bounced light, power.
double finished(double open, const OcclusionSettings& settings);

// A picture whose pixels are worked out when they are asked for; beyond its edge the nearest one.
template <typename T>
class Lazy {
 public:
  using Source = std::function<T(const glm::ivec2&)>;
  Lazy(const glm::ivec2& size, Source source)
      : size_(size),
        source_(std::move(source)),
        values_(static_cast<size_t>(size.x) * static_cast<size_t>(size.y)) {}

  const glm::ivec2& size() const { return size_; }
  T operator()(const glm::ivec2& pixel) {
    const glm::ivec2 at = glm::clamp(pixel, glm::ivec2(0), size_ - 1);
    const size_t index =
        static_cast<size_t>(at.y) * static_cast<size_t>(size_.x) + static_cast<size_t>(at.x);
    if (!values_[index]) values_[index] = source_(at);
    return *values_[index];
  }

 private:
  glm::ivec2 size_;
  Source source_;
  std::vector<std::optional<T>> values_;
};

std::unique_ptr<Occlusion> makeClassic(const View& view, const OcclusionSettings& settings);
std::unique_ptr<Occlusion> makeSlices(const View& view, const OcclusionSettings& settings,
                                      std::shared_ptr<const Past> past);

}  // namespace grisaille::lab::oracle
