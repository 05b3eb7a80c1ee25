// SPDX-License-Identifier: MIT
// How far a picture is from a truth that is still being traced.
#pragma once

#include <span>

#include "core/image/image.h"
#include "core/trace/occlusion.h"

namespace grisaille::app::truth {

// The standard error of a pixel that has not been traced.
constexpr float kUntraced = -1;

inline bool isTraced(const trace::Visibility& value) {
  return value.standardError != kUntraced;
}

// One pixel of both.
struct Point {
  float shown = 0, truth = 0, truthError = 0;
};

struct Comparison {
  uint64_t pixels = 0;  // compared: traced, and numbers on both sides
  double rmse = 0;
  double error = 0;  // standard error of `rmse`
  double bias = 0;   // mean of picture - truth
  double noise = 0;  // rms standard error of the truth's pixels
};

// By rows; `shown` of one channel. A pixel's squared difference d^2 holds the square of the truth's
// own error, whose mean s^2 is known, so that
//
//    rmse = sqrt(mean(d^2 - s^2)), or 0 where that mean is negative,
//
// is what rays without end would tell, of any number of rays and of any pixels drawn by chance. The
// mean's own variance is that of drawing n of N pixels and that of the truth's noise, which does
// not end with n = N: d^2 varies by no more than 4 d^2 s^2 with it,
//
//    (1 - n / N) var(d^2 - s^2) / n + (n / N) mean(4 d^2 s^2) / n.
Comparison compare(const image::Image& shown, std::span<const trace::Visibility> truth);

}  // namespace grisaille::app::truth
