// SPDX-License-Identifier: MIT
#include "app/truth/comparison.h"

#include <algorithm>
#include <cmath>

namespace grisaille::app::truth {

Comparison compare(const image::Image& shown, std::span<const trace::Visibility> truth) {
  Comparison result;
  double errors = 0, squares = 0, fourths = 0, noise = 0, noises = 0;
  uint64_t left = 0;  // pixels not traced yet
  for (size_t i = 0; i < truth.size(); ++i) {
    if (!isTraced(truth[i])) {
      ++left;
      continue;
    }
    const double d = double{shown.pixels[i]} - double{truth[i].mean};
    if (!std::isfinite(d)) continue;
    // A pixel without a standard error has too few rays to matter.
    const double s = std::isnan(truth[i].standardError) ? 0 : truth[i].standardError;
    const double square = d * d - s * s;
    errors += d;
    squares += square;
    fourths += square * square;
    noise += s * s;
    noises += 4 * d * d * s * s;
    ++result.pixels;
  }
  if (result.pixels == 0) return result;
  const auto n = static_cast<double>(result.pixels);
  const double share = n / (n + static_cast<double>(left));
  const double mean = squares / n;
  const double spread = std::max(fourths / n - mean * mean, 0.0);
  const double variance = ((1 - share) * spread + share * noises / n) / n;
  result.rmse = std::sqrt(std::max(mean, 0.0));
  // The change of the rmse when the mean grows by one standard error.
  result.error = std::sqrt(std::max(mean, 0.0) + std::sqrt(variance)) - result.rmse;
  result.bias = errors / n;
  result.noise = std::sqrt(noise / n);
  return result;
}

}  // namespace grisaille::app::truth
