// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/image.h"

namespace grisaille::image {
namespace {

void requireSameShape(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels ||
      a.pixels.size() != b.pixels.size()) {
    throw Error(ErrorId::kImageMismatch, "{} x {} with {} channels against {} x {} with {}",
                a.width, a.height, a.channels, b.width, b.height, b.channels);
  }
}

}  // namespace

Difference compare(const Image& a, const Image& b) {
  requireSameShape(a, b);
  Difference result;
  std::vector<double> absolute;
  absolute.reserve(a.pixels.size());
  double sum = 0, sumAbsolute = 0, sumSquares = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (!std::isfinite(a.pixels[i]) || !std::isfinite(b.pixels[i])) {
      ++result.nonFinite;
      continue;
    }
    const double difference = double{a.pixels[i]} - double{b.pixels[i]};
    sum += difference;
    sumAbsolute += std::abs(difference);
    sumSquares += difference * difference;
    absolute.push_back(std::abs(difference));
  }
  result.compared = absolute.size();
  if (absolute.empty()) return result;
  const auto count = static_cast<double>(absolute.size());
  result.rmse = std::sqrt(sumSquares / count);
  result.meanAbsolute = sumAbsolute / count;
  result.bias = sum / count;
  result.largest = *std::max_element(absolute.begin(), absolute.end());
  // Nearest rank: the smallest value that at least 99 % of all do not exceed.
  const size_t rank = (absolute.size() * 99 + 99) / 100 - 1;
  const auto nth = absolute.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(absolute.begin(), nth, absolute.end());
  result.percentile99 = *nth;
  return result;
}

double shareOver(const Image& a, const Image& b, double threshold) {
  requireSameShape(a, b);
  if (a.pixels.empty()) return 0;
  size_t over = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const float x = a.pixels[i], y = b.pixels[i];
    if (std::isfinite(x) && std::isfinite(y)) {
      if (std::abs(double{x} - double{y}) > threshold) ++over;
    } else if (x != y && !(std::isnan(x) && std::isnan(y))) {
      ++over;
    }
  }
  return static_cast<double>(over) / static_cast<double>(a.pixels.size());
}

}  // namespace grisaille::image
