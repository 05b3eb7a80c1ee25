// SPDX-License-Identifier: MIT
// The oracle of ssao: computes the ambient visibility of effects/ssao/README.md in double
// precision.
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
  int kernelSize = 12;  // taps a pixel; of slices: of all slices, both sides
  int blurSize = 10;    // pixels
  double bias = 0;
  int slices = 1, edgeSlices = 1;
  double thickness = 0.7;  // radii
  // Where matter ends: after `thickness`, or by the view's thickness or back depth if it is known.
  // kPeeled also knows the next surface.
  enum class Backs { kAssumed, kBodies, kDrawn, kPeeled } backs = Backs::kAssumed;
  int history = 1;  // frames; over 1 needs a Past from the second frame on
  int scale = 2;    // pixels per texel: 1, 2 or 4
  // Pixels that are computed at full resolution below it.
  enum class Refine { kNothing, kEdges, kContrasts } refine = Refine::kNothing;
  double contrast = 0.1;  // with kContrasts
  int edgeDenoise = 6;
  double intensity = 1, power = 1;
  double albedo = 0;        // albedo of the bounce; 0: no bounce
  bool baseColour = false;  // the tint's bounce uses the view's base colours
  uint32_t seed = 0;
  // classic: how much nearer than a sample point an occluder must be, metres, in place of the
  // rounding tolerance and the move along the tangent plane.
  std::optional<double> depthBias = {};
  bool sphere = false, rotated = true, edgeAware = false;
  enum class Range { kLinear, kRawDepth, kNone } range = Range::kLinear;
};

// The history of slices after a frame, for the next frame.
class Past {
 public:
  virtual ~Past() = default;
};

// Computes each value once, on its first use. Not thread-safe.
class Occlusion {
 public:
  virtual ~Occlusion() = default;
  // Visibility of a pixel of the picture, 0 to 1.
  virtual double visibility(const glm::ivec2& pixel) = 0;
  // World space, length 1. Only slices compute it: classic returns that of slices.
  virtual glm::dvec3 bentNormal(const glm::ivec2& pixel) = 0;
  // The history for the next frame: computes all pixels. Null for classic.
  virtual std::shared_ptr<const Past> past() = 0;
};

// The output `tint` of a pixel, by channel, 0 to 1.
glm::dvec3 tintOf(Occlusion& occlusion, const View& view, const OcclusionSettings& settings,
                  const glm::ivec2& pixel);

// `view` must outlive the result and all histories that follow from it. `past`: history of the
// previous frame; null in the first frame.
std::unique_ptr<Occlusion> makeOcclusion(const View& view, const OcclusionSettings& settings,
                                         std::shared_ptr<const Past> past = nullptr);

// The last pass: intensity, bounced light, power.
double finished(double open, const OcclusionSettings& settings);

// A picture that computes each pixel on its first use. Beyond its border it returns the nearest
// pixel.
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

// A surface's point, raised by the bias along its normal: matter lower than that does not occlude.
struct Raised {
  glm::dvec3 position;  // view space
  glm::dvec2 pixel;     // (0, 0): the centre of the top left pixel
};
// Nothing if the raised point is not in front of the near plane.
std::optional<Raised> raisedBy(const View& view, const glm::ivec2& pixel, const glm::dvec3& normal,
                               double bias);

std::unique_ptr<Occlusion> makeClassic(const View& view, const OcclusionSettings& settings);
std::unique_ptr<Occlusion> makeSlices(const View& view, const OcclusionSettings& settings,
                                      std::shared_ptr<const Past> past);

}  // namespace grisaille::lab::oracle
