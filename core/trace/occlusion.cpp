// SPDX-License-Identifier: MIT
#include "core/trace/occlusion.h"

#include <cmath>
#include <limits>

#include "core/trace/ray_tracer.h"

namespace grisaille::trace {
namespace {

Visibility visibilityOf(const OcclusionCounts& counts) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  double counted = 0, open = 0;
  uint32_t used = 0;
  for (size_t k = 0; k < kScrambles; ++k) {
    counted += counts.counted[k];
    open += counts.open[k];
    used += counts.counted[k] > 0 ? 1 : 0;
  }
  if (counted == 0) return {kNan, kNan};
  const double mean = open / counted;
  if (used < 2) return {static_cast<float>(mean), kNan};
  double squares = 0;
  for (size_t k = 0; k < kScrambles; ++k) {
    const double apart = counts.open[k] - mean * counts.counted[k];
    squares += apart * apart;
  }
  // The formula of Visibility::standardError; `counted` is kScrambles times its mean.
  const double error = std::sqrt(squares * kScrambles / (kScrambles - 1)) / counted;
  return {static_cast<float>(mean), static_cast<float>(error)};
}

}  // namespace

std::vector<Visibility> visibilityOf(std::span<const Hit> hits,
                                     std::span<const OcclusionCounts> counts) {
  std::vector<Visibility> values(hits.size());
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].viewDepth > 0) values[i] = visibilityOf(counts[i]);
  }
  return values;
}

double rmsError(std::span<const Hit> hits, std::span<const Visibility> values) {
  double squares = 0;
  size_t count = 0;
  for (size_t i = 0; i < hits.size(); ++i) {
    const double error = values[i].standardError;
    if (hits[i].viewDepth == 0 || std::isnan(error)) continue;
    squares += error * error;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

}  // namespace grisaille::trace
