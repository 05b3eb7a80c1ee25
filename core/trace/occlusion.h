// SPDX-License-Identifier: MIT
// Ambient visibility as counts of rays, which more rays refine.
//
// A pixel's rays are those of kScrambles Sobol sequences, scrambled independently of one another:
// ray i is point i / kScrambles of sequence i % kScrambles. Each sequence alone is an unbiased
// estimate that converges as such points do; that they are independent of one another lets their
// spread tell the error.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace grisaille::trace {

struct Hit;

constexpr uint32_t kScrambles = 8;
constexpr uint32_t kMostOcclusionRays = 1u << 18;  // a pixel: 16 bits hold a sequence's count

// What one pixel's rays met so far. Rays that go under the facet are not counted.
struct OcclusionCounts {
  std::array<uint16_t, kScrambles> counted{};
  std::array<uint16_t, kScrambles> open{};

  bool operator==(const OcclusionCounts&) const = default;
};

// 1 without an error for the sky; NaN where every ray went under the facet.
struct Visibility {
  float mean = 1;  // open rays by counted rays
  // The standard error of the mean, from the spread of the sequences (that of a ratio of sums):
  // sqrt(sum of (open_k - mean counted_k)^2 / (kScrambles (kScrambles - 1))) / mean of counted_k.
  // Its square is all but unbiased, so that the root mean square over many pixels is sound; that of
  // one pixel has 7 degrees of freedom, and is 0 where all sequences happen to agree. It knows of
  // chance alone: not of what a pixel's centre leaves out, nor of rounding. NaN where fewer than
  // two sequences have rays.
  float standardError = 0;
};

// One an element of `hits`, whose counts stand in their order.
std::vector<Visibility> visibilityOf(std::span<const Hit> hits,
                                     std::span<const OcclusionCounts> counts);

// Root mean square of the standard errors that are numbers, over surfaces: the sky has none. 0: no
// pixel is left.
double rmsError(std::span<const Hit> hits, std::span<const Visibility> values);

}  // namespace grisaille::trace
