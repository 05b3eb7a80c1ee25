// SPDX-License-Identifier: MIT
// Ambient visibility as counts of rays. Adding rays refines it.
//
// A pixel's rays come from kScrambles independently scrambled Sobol sequences: ray i is point
// i / kScrambles of sequence i % kScrambles. Each sequence alone is an unbiased estimate with the
// convergence of Sobol points. Because the sequences are independent, their spread gives the error.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace grisaille::trace {

struct Hit;

constexpr uint32_t kScrambles = 8;
constexpr uint32_t kMostOcclusionRays = 1u << 18;  // per pixel; counts of a sequence have 16 bits

// The results of one pixel's rays, per sequence. Rays below the facet are not counted.
struct OcclusionCounts {
  std::array<uint16_t, kScrambles> counted{};
  std::array<uint16_t, kScrambles> open{};  // counted rays that are not blocked

  bool operator==(const OcclusionCounts&) const = default;
};

// The ambient visibility of one pixel. Sky: mean 1, error 0. Both are NaN if every ray went below
// the facet.
struct Visibility {
  float mean = 1;  // open rays / counted rays
  // The standard error of the mean, from the spread of the sequences (that of a ratio of sums):
  // sqrt(sum of (open_k - mean counted_k)^2 / (kScrambles (kScrambles - 1))) / mean of counted_k.
  // Its square is almost unbiased, therefore the root mean square over many pixels is reliable. For
  // one pixel it has 7 degrees of freedom, and is 0 if all sequences happen to agree. It covers
  // only sampling noise: not the parts of a pixel beside its centre, nor rounding. NaN if fewer
  // than two sequences have rays.
  float standardError = 0;
};

// Returns one value per element of `hits`. `counts` has the same length and order as `hits`.
std::vector<Visibility> visibilityOf(std::span<const Hit> hits,
                                     std::span<const OcclusionCounts> counts);

// Returns the root mean square of the standard errors of surface pixels, without NaN. The sky has
// no error and is left out. Returns 0 if no pixel remains.
double rmsError(std::span<const Hit> hits, std::span<const Visibility> values);

}  // namespace grisaille::trace
