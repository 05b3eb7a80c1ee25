// SPDX-License-Identifier: MIT
// Compares a picture with a truth that is still being traced.
#pragma once

#include <span>

#include "core/image/image.h"
#include "core/trace/occlusion.h"

namespace grisaille::app::truth {

// Stored as the standard error of a pixel that is not traced yet.
constexpr float kUntraced = -1;

inline bool isTraced(const trace::Visibility& value) {
  return value.standardError != kUntraced;
}

// One pixel of the picture and of the truth.
struct Point {
  float shown = 0, truth = 0, truthError = 0;
};

struct Comparison {
  uint64_t pixels = 0;  // compared pixels: traced, and finite in both pictures
  double rmse = 0;
  double error = 0;  // standard error of `rmse`
  double bias = 0;   // mean of picture - truth
  double noise = 0;  // rms standard error of the truth's pixels
};

// `shown`: one channel, by rows like `truth`. A pixel's squared difference d^2 includes the squared
// error of the truth, with the known mean s^2. Therefore
//
//    rmse = sqrt(mean(d^2 - s^2)), or 0 if that mean is negative,
//
// estimates the rmse against infinitely many rays, for any number of rays and any random choice of
// pixels. The variance of the mean has two parts: drawing n of N pixels, and the truth's noise,
// which remains at n = N and varies d^2 by at most 4 d^2 s^2:
//
//    (1 - n / N) var(d^2 - s^2) / n + (n / N) mean(4 d^2 s^2) / n.
Comparison compare(const image::Image& shown, std::span<const trace::Visibility> truth);

}  // namespace grisaille::app::truth
