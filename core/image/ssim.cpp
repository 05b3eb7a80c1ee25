// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/image/image.h"

namespace grisaille::image {
namespace {

constexpr uint32_t kSide = 11;  // side of a window, pixels
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01;  // (K1 x range)^2
constexpr double kC2 = 0.03 * 0.03;

using Weights = std::array<double, kSide>;
// Weighted means of a, b, a^2, b^2 and a b, over a window or one row of it.
using Moments = std::array<double, 5>;

// The weights along one axis; the window is separable.
Weights gaussian() {
  Weights weights;
  double sum = 0;
  for (uint32_t i = 0; i < kSide; ++i) {
    const double x = (i - (kSide - 1) / 2.0) / kSigma;
    sum += weights[i] = std::exp(-x * x / 2);
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Moments of one row of a window. NaN if a pixel is not finite.
Moments rowMoments(const float* a, const float* b, const Weights& weights) {
  Moments sums{};
  for (uint32_t i = 0; i < kSide; ++i) {
    const double x = a[i], y = b[i];
    if (!std::isfinite(x) || !std::isfinite(y)) sums[0] = std::numeric_limits<double>::quiet_NaN();
    const Moments one = {x, y, x * x, y * y, x * y};
    for (size_t k = 0; k < one.size(); ++k) sums[k] += weights[i] * one[k];
  }
  return sums;
}

double similarity(const Moments& m) {
  const auto& [a, b, aa, bb, ab] = m;
  return (2 * a * b + kC1) * (2 * (ab - a * b) + kC2) /
         ((a * a + b * b + kC1) * (aa - a * a + bb - b * b + kC2));
}

}  // namespace

Similarity ssim(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels != 1 || b.channels != 1 ||
      a.pixels.size() != b.pixels.size()) {
    throw Error(ErrorId::kImageMismatch, "SSIM of {} x {} with {} channels against {} x {} with {}",
                a.width, a.height, a.channels, b.width, b.height, b.channels);
  }
  Similarity result;
  if (a.width < kSide || a.height < kSide) return result;
  const Weights weights = gaussian();
  const size_t across = a.width - kSide + 1;
  std::vector<Moments> rows(across * a.height);
  for (size_t y = 0; y < a.height; ++y) {
    for (size_t x = 0; x < across; ++x) {
      const size_t at = y * a.width + x;
      rows[y * across + x] = rowMoments(&a.pixels[at], &b.pixels[at], weights);
    }
  }
  double sum = 0;
  for (size_t window = 0; window < rows.size() - (kSide - 1) * across; ++window) {
    Moments moments{};
    for (uint32_t i = 0; i < kSide; ++i) {
      const Moments& row = rows[window + i * across];
      for (size_t k = 0; k < row.size(); ++k) moments[k] += weights[i] * row[k];
    }
    const double value = similarity(moments);
    if (std::isnan(value)) {
      ++result.leftOut;
    } else {
      sum += value;
      ++result.windows;
    }
  }
  if (result.windows > 0) result.mean = sum / static_cast<double>(result.windows);
  return result;
}

}  // namespace grisaille::image
